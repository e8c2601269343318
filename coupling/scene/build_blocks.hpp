#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupling/config/settings.hpp"
#include "coupling/scene/ensemble_flow.hpp"
#include "micro/ensemble/blocks/block_ensemble.hpp"
#include "micro/ensemble/box.hpp"

namespace hemoscale::coupling {

/// Whether the ensemble of a case is advanced on vectors (micro.integrator), and not by the
/// explicit reference.
bool runs_on_vectors(const Settings& settings);

/// Whether the step of an ensemble must stay below the limit of explicit schemes.
bool has_explicit_limit(const Settings& settings);

/// An ensemble on vectors, ready to be started.
struct BlockScene {
  micro::blocks::BlockSettings settings;
  micro::Precision precision = micro::Precision::single;
  micro::Box box;                                       // the plane channel; empty in a geometry
  std::vector<std::string> names;                       // of the kinds of cells
  std::vector<std::vector<micro::Vector<2>>> outlines;  // [m] of the kinds, at rest
  EnsembleFlow flow;
};

/// Settings of the kinds of cells, forces, flow, scheme and step of a case; nothing is packed.
///
/// Default of the time step: 0.8 of the limit (block_limits.hpp), with implicit schemes at most
/// 3e-4 over the largest shear rate of the flow, in which a cell turns by 1.5e-4. A step beyond the
/// limit is refused by the model, unless forced, and by `ensemble_faults` before.
///
/// @param case_folder, results  see build_ensemble_flow
/// @throws CaseError, EnvironmentError of the flow; micro::ParameterError
BlockScene build_blocks(const Settings& settings, int threads, bool force,
                        const std::filesystem::path& case_folder,
                        const std::filesystem::path& results);

/// Initial places of all kinds of cells.
/// @throws CaseError with the key to be changed for what cannot be packed, and for cells that
/// overlap
///         or reach beyond a wall
std::vector<micro::EnsembleState> pack_blocks(const Settings& settings, const BlockScene& scene);

}  // namespace hemoscale::coupling
