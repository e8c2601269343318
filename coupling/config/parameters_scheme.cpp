#include <string>

#include "coupling/config/parameter_sections.hpp"

namespace hemoscale::coupling {

using Kind = ParameterKind;

namespace {

Parameter of_ensemble(const std::string& key, Kind kind, const std::string& default_value,
                      const std::string& sentence) {
  return {.key = key,
          .kind = kind,
          .default_value = default_value,
          .applies_when = {{"micro.model", "ensemble"}},
          .sentence = sentence};
}

Parameter quantity(const std::string& key, const std::string& unit, Range range,
                   const std::string& default_value, const std::string& sentence) {
  Parameter parameter =
      of_ensemble(key, unit.empty() ? Kind::number : Kind::quantity, default_value, sentence);
  parameter.unit = unit;
  parameter.range = range;
  return parameter;
}

std::vector<Parameter> platelet_parameters() {
  Parameter nodes = of_ensemble("micro.platelets.nodes", Kind::integer, "24",
                                "Nodes of the membrane of a platelet.");
  nodes.range = between(8, 1000);
  return {
      quantity("micro.platelets.per_cell", "", between(0, 10), "0",
               "Platelets for each red cell; they are carried along and meet cells by the same "
               "contact law."),
      nodes,
      quantity("micro.platelets.length", "m", above(0), "2.5 um",
               "Length of a platelet, an ellipse."),
      quantity("micro.platelets.aspect", "", between(0.1, 1), "0.4",
               "Thickness of a platelet over its length."),
      quantity("micro.platelets.stretch_modulus", "N/m", above(0), "2e-5 N/m",
               "Resistance of its membrane to stretching, per unit depth."),
      quantity("micro.platelets.bending_modulus", "J", at_least(0), "2e-18 J",
               "Resistance of its membrane to bending, per unit depth times length."),
      quantity("micro.platelets.drag_coefficient", "", above(0), "12",
               "Drag of a platelet per unit depth over the plasma viscosity, shared by its nodes."),
  };
}

/// How an ensemble is spread over ranks.
std::vector<Parameter> region_parameters() {
  const auto on_vectors = [](Parameter parameter) {
    parameter.applies_when.push_back({"micro.domain", "shear-box", true});
    parameter.applies_when.push_back({"micro.integrator", "explicit-reference", true});
    return parameter;
  };
  Parameter copies = of_ensemble("micro.regions.copies", Kind::choice, "flow",
                                 "How copies of cells of other ranks move between two exchanges: "
                                 "with the flow, or frozen in place (Tsubota et al. 2006).");
  copies.choices = {"flow", "frozen"};
  Parameter interval =
      of_ensemble("micro.regions.exchange_interval", Kind::integer, "",
                  "Steps between exchanges of copies; with 1 results do not depend "
                  "on the number of ranks, to the bit.");
  interval.range = between(1, 100000);
  interval.default_value.reset();
  interval.default_note = "the longest with errors below 0.02 um in two seconds of the vessel";
  Parameter growth =
      of_ensemble("micro.regions.copy_growth", Kind::number, "1.3",
                  "Cells are dealt out to the ranks anew, at equal work, when copies "
                  "have become so many times as many as after the last time.");
  growth.range = above(1);
  return {on_vectors(copies), on_vectors(interval), on_vectors(growth)};
}

}  // namespace

std::vector<Parameter> ensemble_scheme_parameters() {
  Parameter integrator =
      of_ensemble("micro.integrator", Kind::choice, "",
                  "How the nodes are advanced: explicit-reference (double precision, cell after "
                  "cell), or on vectors: explicit; linearly-implicit (full derivative of the "
                  "membrane's forces); constant-operator (implicit, simplified Newton step) of "
                  "first or, constant-operator-2, of second order; inertial (explicit, nodes with "
                  "mass); chebyshev (stabilised explicit Runge-Kutta, RKC2).");
  integrator.choices = {"explicit-reference",  "explicit", "linearly-implicit", "constant-operator",
                        "constant-operator-2", "inertial", "chebyshev"};
  integrator.default_value.reset();
  integrator.default_note =
      "explicit-reference in a shear box, constant-operator-2 in a channel or geometry";
  Parameter stages = of_ensemble("micro.chebyshev.stages", Kind::integer, "10",
                                 "Stages of a step; the limit of the time step grows with their "
                                 "square.");
  stages.range = between(2, 50);
  stages.applies_when.push_back({"micro.integrator", "chebyshev"});
  Parameter precision = of_ensemble("micro.precision", Kind::choice, "single",
                                    "Precision of nodes relative to their cells on vectors; the "
                                    "places of cells, and explicit-reference, are double.");
  precision.choices = {"single", "double"};
  Parameter packing = of_ensemble("micro.packing.kind", Kind::choice, "random",
                                  "Initial places of the cells: at random, on a lattice with "
                                  "random tilts, or as a table says.");
  packing.choices = {"random", "lattice", "table"};
  packing.applies_when.push_back({"micro.domain", "geometry", true});
  const auto of_lattice = [](Parameter parameter) {
    parameter.applies_when.push_back({"micro.packing.kind", "lattice"});
    return parameter;
  };
  Parameter rows = of_ensemble("micro.packing.rows", Kind::integer, "",
                               "Rows of the lattice, one above the other.");
  rows.range = between(1, 100000);
  rows.default_value.reset();
  rows.default_note = "as gives equal gaps along and across the flow";
  Parameter places =
      of_ensemble("micro.packing.table", Kind::path, "",
                  "Comma-separated table of the centres and angles of the cells, "
                  "with the header x [m],y [m],angle [rad], relative to the folder of "
                  "the case file.");
  places.default_value.reset();
  places.required = true;
  places.applies_when.push_back({"micro.packing.kind", "table"});
  std::vector<Parameter> table = {
      integrator,
      precision,
      stages,
      packing,
      of_lattice(quantity("micro.packing.tilt", "rad", between(0, 1.6), "2 degree",
                          "Largest tilt of a cell on the lattice; a perfect lattice slides past "
                          "itself without contacts.")),
      of_lattice(quantity("micro.packing.orientation", "rad", between(-3.2, 3.2), "0 rad",
                          "Angle of the long axes of the cells on the lattice from the flow.")),
      of_lattice(rows),
      places,
      quantity("micro.list_skin", "m", above(0), "0.4 um",
               "Reach of contact lists beyond the cutoff; it decides the cost, never a result."),
  };
  for (const auto& part : {platelet_parameters(), region_parameters()}) {
    table.insert(table.end(), part.begin(), part.end());
  }
  return table;
}

}  // namespace hemoscale::coupling
