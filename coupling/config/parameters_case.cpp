#include "coupling/config/parameter_sections.hpp"

namespace hemoscale::coupling {

using Kind = ParameterKind;

std::vector<Parameter> case_parameters() {
  return {
      {.key = "case.name",
       .kind = Kind::name,
       .required = true,
       .sentence = "Names the case in results and messages."},
      {.key = "case.description",
       .kind = Kind::text,
       .default_value = "",
       .sentence = "What the case asks, for the reader of its results."},
      {.key = "case.seed",
       .kind = Kind::integer,
       .range = at_least(0),
       .default_value = "1",
       .sentence = "Every random number of a run comes from it: same seed, same results."},
      {.key = "case.variant",
       .kind = Kind::name,
       .default_note = "the case itself, without a variant",
       .sentence = "The variant that is used when the command line names none."},
      {.key = "scene.kind",
       .kind = Kind::choice,
       .choices = {"coupled", "micro"},
       .default_value = "coupled",
       .sentence = "The coupled loop of macro flow and micro models, or one micro model alone."},
      {.key = "micro.model",
       .kind = Kind::choice,
       .choices = {"ensemble", "plasma", "synthetic"},
       .default_value = "ensemble",
       .sentence =
           "Deformable cells in a given flow (ensemble), plasma resolved by particles (plasma), or "
           "a known law with noise, for tests of the coupling (synthetic)."},
      {.key = "fluid.plasma_viscosity",
       .kind = Kind::quantity,
       .unit = "Pa s",
       .range = between(1e-5, 1),
       .default_value = "1.2 mPa s",
       .sentence = "Dynamic viscosity of the plasma; the default is that of plasma at 37 C."},
      {.key = "fluid.density",
       .kind = Kind::quantity,
       .unit = "kg/m^3",
       .range = between(1, 1e4),
       .default_value = "1050 kg/m^3",
       .sentence = "Density of the blood."},
      {.key = "fluid.hematocrit",
       .kind = Kind::number,
       .range = between(0, 0.75),
       .default_value = "0",
       .default_when = {{"micro.model", "plasma"}},
       .sentence = "Volume fraction of red cells in the feed; area fraction in two dimensions."},
  };
}

std::vector<Parameter> output_parameters() {
  return {
      {.key = "output.trajectory",
       .kind = Kind::boolean,
       .default_value = "true",
       .sentence = "Write the positions of the nodes of the cells (trajectory.h5)."},
      {.key = "output.trajectory_interval",
       .kind = Kind::number,
       .range = above(0),
       .default_value = "1",
       .sentence =
           "Strain between frames of the trajectory; in coupled scenes of the last micro run "
           "of each point."},
      {.key = "output.nodes",
       .kind = Kind::boolean,
       .default_value = "false",
       .applies_when = {{"micro.domain", "channel"}},
       .sentence = "Write a table of all nodes of the cells at the end (nodes.csv)."},
      {.key = "output.reference_nodes",
       .kind = Kind::path,
       .default_note = "none",
       .applies_when = {{"micro.domain", "channel"}},
       .sentence = "Table nodes.csv of another run of the same cells, relative to the case file: "
                   "the summary states the root mean square distance of the nodes from it."},
      {.key = "output.checkpoint_interval",
       .kind = Kind::quantity,
       .unit = "s",
       .range = above(0),
       .default_value = "60 s",
       .sentence = "Wall time between checkpoints: the most work that a killed run loses."},
  };
}

}  // namespace hemoscale::coupling
