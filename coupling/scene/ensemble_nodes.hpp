#pragma once

#include <filesystem>
#include <vector>

#include "coupling/config/settings.hpp"
#include "micro/ensemble/state.hpp"

namespace hemoscale::coupling {

/// Writes nodes.csv: where every node is, cell after cell, kind after kind, in the coordinates in
/// which cells move: the period is not subtracted.
/// @throws EnvironmentError
void write_nodes(const std::filesystem::path& path,
                 const std::vector<micro::EnsembleState>& states);

/// Root mean square distance of the nodes from those of another run of the same cells [m], whose
/// nodes.csv output.reference_nodes names.
/// @throws CaseError if the table is not one of as many nodes
/// @throws EnvironmentError if there is none
double distance_from_reference(const Settings& settings, const std::filesystem::path& case_folder,
                               const std::vector<micro::EnsembleState>& states);

}  // namespace hemoscale::coupling
