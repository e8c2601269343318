#include <string>

#include "coupling/config/parameter_sections.hpp"

namespace hemoscale::coupling {

using Kind = ParameterKind;

namespace {

/// A number of the forces on the nodes of an ensemble; without a default it is required.
Parameter force(const std::string& key, const std::string& unit, Range range,
                const std::string& default_value, const std::string& sentence) {
  Parameter parameter = {.key = "micro." + key,
                         .kind = unit.empty() ? Kind::number : Kind::quantity,
                         .unit = unit,
                         .range = range,
                         .applies_when = {{"micro.model", "ensemble"}},
                         .sentence = sentence};
  if (default_value.empty()) {
    parameter.required = true;
  } else {
    parameter.default_value = default_value;
  }
  return parameter;
}

Parameter when(const Condition& condition, Parameter parameter) {
  parameter.applies_when.push_back(condition);
  return parameter;
}

Parameter chosen_by_program(const std::string& note, Parameter parameter) {
  parameter.required = false;
  parameter.default_note = note;
  return parameter;
}

std::vector<Parameter> drag_parameters() {
  const Condition inertial{"micro.integrator", "inertial"};
  Parameter convention = {
      .key = "micro.drag.convention",
      .kind = Kind::choice,
      .choices = {"cell", "node"},
      .default_value = "cell",
      .applies_when = {{"micro.model", "ensemble"}},
      .sentence =
          "Whether the coefficient is the drag of a cell, shared by its nodes, or of "
          "each node; the step limit depends on it."};
  Parameter coefficient =
      force("drag.coefficient", "", above(0), "12",
            "Drag per unit depth over the plasma viscosity: the viscous force on a node is zeta (u "
            "- v) for the given flow u.");
  coefficient.default_when = {{"micro.drag.convention", "cell"}};
  return {
      convention, coefficient,
      force("drag.normal_ratio", "", above(0), "1",
            "Drag of a node across the membrane over that along it; other than 1 with the "
            "integrators explicit and chebyshev alone."),
      when(inertial, force("drag.momentum", "kg/m^2", at_least(0), "0 kg/m^2",
                           "Momentum drag k of the force k |u - v| (u - v) per unit depth (Tsubota "
                           "et al. 2006), of a cell or a node by micro.drag.convention.")),
      when(inertial,
           chosen_by_program("fluid.density times the area of a cell at rest",
                             force("inertia.cell_mass", "kg/m", above(0), "",
                                   "Mass of a cell per unit depth, shared by its nodes: m dv/dt = "
                                   "F + zeta (u - v) + k |u - v| (u - v).")))};
}

std::vector<Parameter> contact_parameters() {
  const Condition polynomial{"micro.contact.law", "polynomial"};
  const Condition morse{"micro.contact.law", "morse"};
  const Condition lennard_jones{"micro.contact.law", "lennard-jones"};
  Parameter law = {
      .key = "micro.contact.law",
      .kind = Kind::choice,
      .choices = {"polynomial", "morse", "lennard-jones"},
      .default_value = "polynomial",
      .applies_when = {{"micro.model", "ensemble"}},
      .sentence =
          "Force between nodes of different cells at the distance r: polynomial, F ~ "
          "(rc^2 - r^2)^2 (r0^2 - r^2) r; Morse (1929) or Lennard-Jones (1924), shifted "
          "to vanish at the cutoff, on vectors alone."};
  Parameter cutoff = force("contact.cutoff", "m", above(0), "0.8 um",
                           "Distance rc beyond which nodes of different cells do not interact.");
  cutoff.exceeds = Order{"micro.contact.rest_distance"};
  Parameter core =
      when(lennard_jones,
           chosen_by_program("0.9 of the rest distance",
                             force("contact.lennard_jones.core", "m", above(0), "",
                                   "Distance below which the force continues along its tangent, so "
                                   "that its stiffness is bounded.")));
  return {
      law,
      when(polynomial,
           force("contact.stiffness", "Pa", at_least(0), "10 Pa",
                 "Slope -dF/dr of the force between two nodes of different cells at the rest "
                 "distance, per unit depth.")),
      force("contact.rest_distance", "m", above(0), "0.5 um",
            "Distance r0 at which nodes of different cells neither repel nor attract; with Morse "
            "and Lennard-Jones before the shift."),
      cutoff,
      when(polynomial, force("contact.attraction", "", between(0, 10), "0.05",
                             "Scale of the attraction over that of the repulsion.")),
      when(morse, force("contact.morse.energy_scale", "N", above(0), "",
                        "Energy D per unit depth of the pair energy D [exp(2 b (r0 - r)) - 2 exp(b "
                        "(r0 - r))].")),
      when(morse, force("contact.morse.steepness", "1/m", above(0), "",
                        "Inverse length b of that law; b times the cutoff must not exceed 20.")),
      when(lennard_jones,
           force("contact.lennard_jones.energy_scale", "N", above(0), "",
                 "Energy e per unit depth of the pair energy e [(r0/r)^12 - 2 (r0/r)^6].")),
      core};
}

std::vector<Parameter> wall_parameters() {
  return {force("wall.stiffness", "Pa", at_least(0), "10 Pa",
                "Slope of the repulsion of a node by a wall, per unit depth."),
          force("wall.range", "m", above(0), "0.5 um",
                "Distance at which the repulsion of a wall begins.")};
}

/// Laws for what a given flow cannot give; none by default.
std::vector<Parameter> migration_parameters() {
  const auto law = [](const std::string& key, const std::string& sentence) {
    Parameter parameter = when({"micro.domain", "channel"},
                               force("migration." + key, "", at_least(0), "0", sentence));
    return when({"micro.integrator", "explicit-reference", true}, parameter);
  };
  return {law("wall_lift",
              "Coefficient U of a drift of whole cells away from both walls, dy/dt = k [1/y^2 - "
              "1/(H - y)^2], k = U gamma R^3 (Olla 1997; Coupier et al. 2008), gamma the largest "
              "shear rate and 2 pi R the perimeter; near 0.1 for red cells, 0: none."),
          law("shear_lift",
              "Coefficient xi of a drift towards the axis, dy/dt = xi |gamma(y)| R^2/d at the "
              "distance d from the nearest wall (Coupier et al. 2008); 0.153 for resolved "
              "two-dimensional cells, 0: none."),
          law("shear_diffusion",
              "Coefficient K of a random walk of whole cells, D = K |gamma(y)| R^2 (Leighton and "
              "Acrivos 1987), for collisions that are left out; 0: none.")};
}

}  // namespace

std::vector<Parameter> ensemble_force_parameters() {
  std::vector<Parameter> table;
  for (const auto& part :
       {drag_parameters(), contact_parameters(), wall_parameters(), migration_parameters()}) {
    table.insert(table.end(), part.begin(), part.end());
  }
  return table;
}

}  // namespace hemoscale::coupling
