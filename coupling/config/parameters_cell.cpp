#include <string>

#include "coupling/config/parameter_sections.hpp"

namespace hemoscale::coupling {

using Kind = ParameterKind;

namespace {

const Condition in_plasma = {"micro.plasma.membranes", "none", true};

Parameter quantity(const std::string& key, const std::string& unit, Range range,
                   const std::string& default_value, const std::string& sentence) {
  Parameter parameter = {.key = "micro.cell." + key,
                         .kind = unit.empty() ? Kind::number : Kind::quantity,
                         .unit = unit,
                         .range = range,
                         .applies_when = {in_plasma},
                         .sentence = sentence};
  if (!default_value.empty()) parameter.default_value = default_value;
  return parameter;
}

Parameter choice(const std::string& key, const std::vector<std::string>& choices,
                 const std::string& sentence) {
  Parameter parameter = quantity(key, "", {}, choices.front(), sentence);
  parameter.kind = Kind::choice;
  parameter.choices = choices;
  return parameter;
}

Parameter count(const std::string& key, Range range, const std::string& default_value,
                const std::string& sentence) {
  Parameter parameter = quantity(key, "", range, default_value, sentence);
  parameter.kind = Kind::integer;
  return parameter;
}

Parameter only_when(Parameter parameter, const Condition& condition) {
  parameter.applies_when.push_back(condition);
  return parameter;
}

Parameter required(Parameter parameter) {
  parameter.default_value.reset();
  parameter.required = true;
  return parameter;
}

Parameter noted(Parameter parameter, const std::string& note) {
  parameter.default_note = note;
  return parameter;
}

std::vector<Parameter> shape_parameters() {
  const Condition deflated = {"micro.cell.outline", "deflated"};
  const Condition not_deflated = {"micro.cell.outline", "deflated", true};
  const Condition in_table = {"micro.cell.outline", "table"};
  const Condition not_in_table = {"micro.cell.outline", "table", true};
  Parameter table = only_when(
      required(quantity("outline_table", "", {}, "",
                        "File of the nodes at rest, counter-clockwise, as a table with the header "
                        "\"x [m],y [m]\"; relative to the case.")),
      in_table);
  table.kind = Kind::path;
  const Condition ellipse = {"micro.cell.outline", "ellipse"};
  return {
      count("count", between(1, 1000), "1", "Number of cells."),
      choice("outline", {"deflated", "evans-fung", "ellipse", "table"},
             "Shape at rest: a circle deflated at constant perimeter to the least bending energy "
             "(Tsubota et al. 2006), the section of the human cell by Evans and Fung (1972), an "
             "ellipse, or nodes from a table."),
      table,
      only_when(count("nodes", between(16, 1000), "59", "Nodes of the membrane of a cell."),
                not_in_table),
      only_when(
          quantity("perimeter", "m", above(0), "19.27 um",
                   "Perimeter of the deflated cell; the default is that of the section of the "
                   "human cell."),
          deflated),
      only_when(quantity("reduced_area", "", between(0.28, 1), "0.46",
                         "4 pi area / perimeter^2 of the deflated cell: 0.46 of the human section, "
                         "0.30 for the literal reading of \"decrease by 70 %\"."),
                deflated),
      only_when(
          only_when(quantity("length", "m", above(0), "7.82 um", "Length of the cell at rest."),
                    not_deflated),
          not_in_table),
      only_when(quantity("aspect", "", between(0.1, 1), "0.35",
                         "Thickness of the ellipse over its length."),
                ellipse),
      quantity("viscosity_ratio", "", {.lowest = 0, .highest = 1000, .lowest_allowed = false}, "1",
               "Viscosity inside over that of the plasma; other than 1 with implicit alone."),
  };
}

std::vector<Parameter> place_parameters() {
  Parameter centres = noted(quantity("centres", "m", {}, "",
                                     "Centre of each cell instead of the "
                                     "three keys before."),
                            "one cell after the other along the flow");
  centres.kind = Kind::points;
  return {
      noted(quantity("x", "m", {}, "", "Abscissa of the centre of the first cell."),
            "1.5 heights behind the inlet, a quarter of a periodic channel, 0 in unbounded flow"),
      noted(quantity("y", "m", {}, "", "Height of the centres of the cells."),
            "the middle of the channel, 0 in unbounded flow"),
      noted(quantity("distance", "m", above(0), "",
                     "Distance of the centres of one cell and the next along the flow."),
            "needed by more than one cell, unless centres are given"),
      centres,
      quantity("angle", "rad", between(-3.2, 3.2), "90 degree",
               "Angle between the long axis of the cells and the flow at the start."),
  };
}

std::vector<Parameter> membrane_parameters() {
  const Condition stretches = {"micro.cell.stretch_law", "inextensible", true};
  const Condition penalty = {"micro.cell.area_law", "penalty"};
  const Condition curved = {"micro.cell.natural_shape", "curvature"};
  return {
      choice("stretch_law", {"inextensible", "linear", "line-element"},
             "Segments of constant length, of a linear line tension, or the line elements of "
             "Tsubota et al. (2006) with one constant for all; the explicit couplings need one "
             "that stretches."),
      only_when(required(quantity("stretch_modulus", "N/m", above(0), "",
                                  "Line tension per strain, per unit depth.")),
                stretches),
      quantity("bending_modulus", "J", at_least(0), "2e-19 J",
               "Resistance to bending, per unit depth times length."),
      choice("bending_law", {"turning-angle", "half-angle-tangent"},
             "Bending energy in the turning angle at a node, or in the tangent of half of it "
             "(Tsubota et al. 2006)."),
      choice(
          "natural_shape", {"flat", "outline", "curvature"},
          "Shape in which the bending energy vanishes: straight, that at rest, or one of uniform "
          "curvature."),
      only_when(required(quantity("spontaneous_curvature", "1/m", {}, "",
                                  "Curvature in which the bending energy vanishes.")),
                curved),
      choice("area_law", {"exact", "penalty"},
             "Enclosed area kept exactly by a projection, or by a pressure that grows with its "
             "change; direct needs the penalty."),
      only_when(required(quantity("area_modulus", "Pa", above(0), "",
                                  "Pressure inside a cell per relative change of its area.")),
                penalty),
  };
}

std::vector<Parameter> coupling_parameters() {
  const Condition implicit = {"micro.plasma.membranes", "implicit"};
  const Condition immersed = {"micro.plasma.membranes", "immersed"};
  return {
      only_when(quantity("step_tolerance", "", between(0, 1), "0.005",
                         "How far a node may end from where its way so far leads it, over the "
                         "radius of the cell: the implicit steps follow from it; 0 for constant "
                         "steps."),
                implicit),
      only_when(
          quantity("sweep_tolerance", "", {.lowest = 0, .highest = 0.1, .lowest_allowed = false},
                   "3e-4",
                   "Change of the velocities by walls and other cells that ends the sweeps of "
                   "an implicit step, over the largest speed."),
          implicit),
      only_when(choice("kernel", {"four-point", "three-point"},
                       "Function that spreads forces and reads velocities (Peskin 2002)."),
                immersed),
      only_when(choice("stepping", {"forward-euler", "adams-bashforth"},
                       "Motion of the nodes, first or second order."),
                immersed),
      quantity("largest_strain", "", above(0), "100",
               "Strain of a segment beyond which a run has failed."),
  };
}

}  // namespace

std::vector<Parameter> cell_in_plasma_parameters() {
  std::vector<Parameter> table;
  for (const auto& part :
       {shape_parameters(), place_parameters(), membrane_parameters(), coupling_parameters()}) {
    table.insert(table.end(), part.begin(), part.end());
  }
  return table;
}

}  // namespace hemoscale::coupling
