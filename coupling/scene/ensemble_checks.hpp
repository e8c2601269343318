#pragma once

#include <string>
#include <vector>

#include "coupling/config/settings.hpp"
#include "coupling/error.hpp"

namespace hemoscale::coupling {

/// Faults of an ensemble of cells that no single key shows, of the explicit reference or on
/// vectors: options that an integrator does not have, laws that are not admissible, a time step
/// beyond the limit (unless forced), a lattice or an area fraction that cannot be packed.
///
/// With micro.domain = "geometry" the limit depends on a flow that OpenFOAM may still have to
/// solve: it is checked when the run begins.
std::vector<Fault> ensemble_faults(const Settings& settings, bool force);

/// The ensemble in words: cells, drag, limit of the time step with what it is made of, the step.
/// @pre ensemble_faults found none
std::string describe_ensemble(const Settings& settings);

}  // namespace hemoscale::coupling
