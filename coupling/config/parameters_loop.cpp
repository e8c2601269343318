#include "coupling/config/parameter_sections.hpp"

namespace hemoscale::coupling {

using Kind = ParameterKind;

namespace {

std::vector<Parameter> sampling_parameters(const std::vector<Condition>& coupled) {
  const std::vector<Condition> across_channel = {{"macro.model", "channel"},
                                                 {"sampling.points", ""}};
  return {
      {.key = "sampling.points",
       .kind = Kind::points,
       .unit = "m",
       .default_note = "points across the channel, see sampling.across",
       .applies_when = coupled,
       .sentence = "Where the flow is sampled and micro models are run."},
      {.key = "sampling.across",
       .kind = Kind::integer,
       .range = between(1, 1000),
       .default_value = "6",
       .applies_when = across_channel,
       .sentence = "Number of points between the axis and the wall of the channel."},
      {.key = "sampling.closest_to_axis",
       .kind = Kind::number,
       .range = between(0, 1),
       .default_value = "0.1",
       .applies_when = across_channel,
       .sentence = "Distance of the innermost point from the axis over half the height."},
      {.key = "sampling.distinct_ratio",
       .kind = Kind::number,
       .range = at_least(1),
       .default_value = "1.05",
       .applies_when = coupled,
       .sentence = "Points whose shear rates differ by less than this factor share one micro run."},
      {.key = "sampling.lowest_shear_rate",
       .kind = Kind::quantity,
       .unit = "1/s",
       .range = above(0),
       .default_value = "1 1/s",
       .applies_when = coupled,
       .sentence =
           "Points with a lower shear rate are not run; the law is held there, and the points "
           "are counted in the summary."},
  };
}

}  // namespace

std::vector<Parameter> loop_parameters() {
  const std::vector<Condition> coupled = {{"scene.kind", "coupled"}};
  std::vector<Parameter> table = sampling_parameters(coupled);
  const std::vector<Parameter> coupling = {
      {.key = "coupling.scheme",
       .kind = Kind::choice,
       .choices = {"one-way", "explicit", "implicit"},
       .default_value = "explicit",
       .applies_when = coupled,
       .sentence =
           "Never return a law (one-way), one pass per window (explicit), or passes repeated "
           "until the law agrees with the flow (implicit)."},
      {.key = "coupling.relaxation",
       .kind = Kind::choice,
       .choices = {"constant", "aitken"},
       .default_value = "constant",
       .applies_when = coupled,
       .sentence = "How the factor of the under-relaxation of log viscosity is chosen."},
      {.key = "coupling.relaxation_factor",
       .kind = Kind::number,
       .range = {.lowest = 0, .highest = 2, .lowest_allowed = false},
       .default_value = "1",
       .applies_when = coupled,
       .sentence = "Share of the new log viscosity that is taken; with aitken, in the first pass."},
      {.key = "coupling.tolerance",
       .kind = Kind::number,
       .range = {.lowest = 0, .highest = 1, .lowest_allowed = false, .highest_allowed = false},
       .default_value = "0.005",
       .applies_when = coupled,
       .sentence = "Root-mean-square change of log viscosity below which the loop has converged."},
      {.key = "coupling.maximum_passes",
       .kind = Kind::integer,
       .range = between(1, 10000),
       .default_value = "20",
       .applies_when = coupled,
       .sentence = "Passes after which the loop stops, converged or not."},
      {.key = "coupling.memory",
       .kind = Kind::choice,
       .choices = {"accumulate", "latest"},
       .default_value = "accumulate",
       .applies_when = coupled,
       .sentence = "Fit the law to the samples of all passes, or of the last pass alone."},
      {.key = "coupling.interval",
       .kind = Kind::integer,
       .range = between(1, 1e6),
       .default_value = "50",
       .applies_when = coupled,
       .sentence = "Steps of the solver per coupling window, when the loop runs inside an OpenFOAM "
                   "solver."},
      {.key = "coupling.lowest_relative_viscosity",
       .kind = Kind::number,
       .range = above(0),
       .default_value = "1",
       .applies_when = coupled,
       .sentence = "Lower bound of the fitted law over the plasma viscosity."},
      {.key = "coupling.highest_relative_viscosity",
       .kind = Kind::number,
       .range = above(0),
       .default_value = "1000",
       .applies_when = coupled,
       .exceeds = Order{"coupling.lowest_relative_viscosity"},
       .sentence = "Upper bound of the fitted law over the plasma viscosity."},
      {.key = "coupling.shear_thinning",
       .kind = Kind::boolean,
       .default_value = "true",
       .applies_when = coupled,
       .sentence = "Fit a viscosity that never rises with the shear rate."},
  };
  table.insert(table.end(), coupling.begin(), coupling.end());
  return table;
}

}  // namespace hemoscale::coupling
