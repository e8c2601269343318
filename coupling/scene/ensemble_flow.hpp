#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/config/settings.hpp"
#include "micro/ensemble/flow/given_flow.hpp"
#include "micro/ensemble/flow/openings.hpp"
#include "micro/ensemble/flow/wall_geometry.hpp"

namespace hemoscale::coupling {

/// What carries the cells of an ensemble in a channel, where its walls are, and where cells enter
/// and leave.
struct EnsembleFlow {
  std::shared_ptr<const micro::GivenFlow> flow;
  std::optional<micro::WallGeometry> walls;  // empty: the plane channel of micro.channel.height
  std::vector<micro::Opening> openings;      // the inlet, then the outlets; empty: periodic
  double overhang = 0;  // [m] for how far walls and flow are continued beyond the openings
  /// What every result of such a flow must state: errors of interpolation and expansion, fluxes.
  std::vector<std::pair<std::string, double>> statements;
};

/// The flow that micro.flow asks for. An OpenFOAM case is solved first, in `results`/flow, if it
/// names a solver and has not been solved there before; of several ranks the root calls this first.
///
/// @param case_folder  of the case file
/// @param results      an existing folder
/// @throws CaseError for a flow that does not fit the domain, patches that the mesh does not have
/// @throws macro::EnvironmentError, EnvironmentError if OpenFOAM or the case is missing or fails
/// @throws NumericalError if the flow that was sampled does not conserve mass
EnsembleFlow build_ensemble_flow(const Settings& settings, const std::filesystem::path& case_folder,
                                 const std::filesystem::path& results);

/// The part of it for micro.flow.kind = "openfoam".
EnsembleFlow build_openfoam_flow(const Settings& settings, const std::filesystem::path& case_folder,
                                 const std::filesystem::path& results);

}  // namespace hemoscale::coupling
