#pragma once

#include <string>
#include <vector>

#include "coupling/config/parameter_table.hpp"

// The parameter table is written down in files, a function for each part; parameter_table()
// joins them. Nothing but parameter_table.cpp calls these.
namespace hemoscale::coupling {

/// case, scene, the choice of the micro model, fluid; output.
std::vector<Parameter> case_parameters();
std::vector<Parameter> output_parameters();

/// macro, and the law that holds before any micro run.
std::vector<Parameter> macro_parameters();

/// sampling, coupling.
std::vector<Parameter> loop_parameters();

/// micro.
std::vector<Parameter> micro_parameters();

/// micro.flow: what carries an ensemble in a channel.
std::vector<Parameter> ensemble_flow_parameters();

/// micro.integrator and what else only an ensemble on vectors has: packing, platelets, ranks.
std::vector<Parameter> ensemble_scheme_parameters();

/// What acts on the nodes of an ensemble: drag, mass, contacts, walls, laws of migration.
std::vector<Parameter> ensemble_force_parameters();

/// micro.plasma, and the flows that it can resolve.
std::vector<Parameter> plasma_parameters();
const std::vector<std::string>& plasma_flows();

/// micro.cell: the red cells in plasma.
std::vector<Parameter> cell_in_plasma_parameters();

/// The parameters of every viscosity law under `section`, e.g. "law" gives "law.casson.viscosity".
/// Those of a law apply when `chooser` names it.
std::vector<Parameter> law_parameters(const std::string& section, const std::string& chooser);

/// The names that a chooser of laws accepts.
std::vector<std::string> law_names();

inline Range above(double lowest) {
  return {.lowest = lowest, .lowest_allowed = false};
}
inline Range at_least(double lowest) {
  return {.lowest = lowest};
}
inline Range between(double lowest, double highest) {
  return {.lowest = lowest, .highest = highest};
}

}  // namespace hemoscale::coupling
