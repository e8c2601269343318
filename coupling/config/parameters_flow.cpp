#include <string>

#include "coupling/config/parameter_sections.hpp"

namespace hemoscale::coupling {

using Kind = ParameterKind;

namespace {

/// A key of the flow that carries an ensemble. In a shear box the shear rate says it all.
Parameter of_flow(const std::string& key, Kind kind, const std::string& sentence,
                  const std::string& kind_of_flow = "") {
  Parameter parameter = {
      .key = "micro.flow." + key,
      .kind = kind,
      .applies_when = {{"micro.model", "ensemble"}, {"micro.domain", "shear-box", true}},
      .sentence = sentence};
  if (!kind_of_flow.empty()) {
    parameter.applies_when.push_back({"micro.flow.kind", kind_of_flow});
  }
  return parameter;
}

Parameter length(const std::string& key, const std::string& default_value,
                 const std::string& sentence) {
  Parameter parameter = of_flow(key, Kind::quantity, sentence, "openfoam");
  parameter.unit = "m";
  parameter.range = above(0);
  parameter.default_value = default_value;
  return parameter;
}

std::vector<Parameter> womersley_parameters() {
  Parameter frequency =
      of_flow("frequency", Kind::quantity,
              "Frequency of the oscillating part of the pressure gradient.", "womersley");
  frequency.unit = "1/s";
  frequency.range = above(0);
  frequency.required = true;
  Parameter amplitude = of_flow("amplitude", Kind::number,
                                "Amplitude of the oscillating pressure gradient over the steady "
                                "one; the flow begins at its peak.",
                                "womersley");
  amplitude.range = at_least(0);
  amplitude.default_value = "0.5";
  Parameter instants = of_flow("instants", Kind::integer,
                               "Instants of a period at which the exact flow is tabulated; it is "
                               "linear in time between them.",
                               "womersley");
  instants.range = between(8, 4096);
  instants.default_value = "128";
  return {frequency, amplitude, instants};
}

std::vector<Parameter> openfoam_parameters() {
  const auto text = [](const std::string& key, const std::string& sentence) {
    return of_flow(key, Kind::text, sentence, "openfoam");
  };
  Parameter folder = text("case",
                          "OpenFOAM case folder, relative to the folder of the case file; itself "
                          "never changed.");
  folder.kind = Kind::path;
  folder.required = true;
  Parameter mesh = text("mesh_command", "Command that makes the mesh before the solver runs.");
  mesh.default_value = "blockMesh";
  Parameter solver =
      text("solver", "OpenFOAM solver to be run in a copy of the case among the results.");
  solver.default_note = "none: the case has been solved already";
  Parameter time = text("time", "Name of the time folder that holds the flow.");
  time.default_note = "the latest";
  Parameter field = text("velocity_field", "Name of the velocity field.");
  field.default_value = "U";
  Parameter length_unit =
      length("length_unit", "1 m",
             "What the length 1 of the mesh means: \"1 um\" for a mesh in micrometres.");
  Parameter time_unit = length("time_unit", "1 s", "What the time 1 of the OpenFOAM case means.");
  time_unit.unit = "s";
  Parameter inlet = text("inlet", "Patch through which blood enters.");
  inlet.required = true;
  Parameter layer = length("cell_free_layer", "0 um",
                           "Layer along the walls of the inlet in which no cell has its centre "
                           "when it enters; without lift none forms on the way.");
  layer.range = at_least(0);
  Parameter settling = length("settling_time", "0 s",
                              "Time from which cells are counted at the outlets; the vessel is "
                              "empty at first.");
  settling.unit = "s";
  settling.range = at_least(0);
  Parameter outlets =
      text("outlets", "Patches through which it leaves, with commas between their names.");
  outlets.required = true;
  return {folder,
          mesh,
          solver,
          time,
          field,
          length_unit,
          time_unit,
          length("grid_spacing", "1 um",
                 "Spacing of the grid on which the flow is sampled; the summary states the error."),
          inlet,
          outlets,
          length("overhang", "10 um",
                 "Length by which walls and flow are continued beyond inlet and outlets, for the "
                 "nodes of cells that pass them."),
          layer,
          settling};
}

}  // namespace

std::vector<Parameter> ensemble_flow_parameters() {
  Parameter kind =
      of_flow("kind", Kind::choice,
              "The given flow: plane Poiseuille flow, pulsatile flow (Womersley 1955), "
              "or the steady flow of an OpenFOAM case (domain geometry).");
  kind.choices = {"poiseuille", "womersley", "openfoam"};
  kind.default_value = "poiseuille";
  std::vector<Parameter> table = {kind};
  for (const auto& part : {womersley_parameters(), openfoam_parameters()}) {
    table.insert(table.end(), part.begin(), part.end());
  }
  return table;
}

}  // namespace hemoscale::coupling
