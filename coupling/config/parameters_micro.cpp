#include <string>

#include "coupling/config/parameter_sections.hpp"

namespace hemoscale::coupling {

using Kind = ParameterKind;

namespace {

/// A physical quantity of the ensemble of cells, with a default.
Parameter of_ensemble(const std::string& key, const std::string& unit, Range range,
                      const std::string& default_value, const std::string& sentence) {
  return {.key = key,
          .kind = unit.empty() ? Kind::number : Kind::quantity,
          .unit = unit,
          .range = range,
          .default_value = default_value,
          .applies_when = {{"micro.model", "ensemble"}},
          .sentence = sentence};
}

Parameter choice_of_ensemble(const std::string& key, const std::vector<std::string>& choices,
                             const std::string& default_value, const std::string& sentence) {
  Parameter parameter = of_ensemble(key, "", {}, default_value, sentence);
  parameter.kind = Kind::choice;
  parameter.choices = choices;
  return parameter;
}

Parameter count_of_ensemble(const std::string& key, Range range, const std::string& default_value,
                            const std::string& sentence) {
  Parameter parameter = of_ensemble(key, "", range, default_value, sentence);
  parameter.kind = Kind::integer;
  return parameter;
}

/// What only a micro model that runs alone needs; in coupled scenes the loop decides it.
Parameter of_lone_run(const std::string& key, const std::string& unit,
                      const std::vector<Condition>& more, const std::string& sentence) {
  Parameter parameter = {.key = key,
                         .kind = Kind::quantity,
                         .unit = unit,
                         .range = above(0),
                         .required = true,
                         .applies_when = {{"scene.kind", "micro"}},
                         .sentence = sentence};
  parameter.applies_when.insert(parameter.applies_when.end(), more.begin(), more.end());
  return parameter;
}

/// Where cells come and go, nothing but the feed says how many there are.
Parameter of_closed_domain(Parameter parameter) {
  parameter.applies_when.push_back({"micro.domain", "geometry", true});
  return parameter;
}

std::vector<Parameter> domain_parameters() {
  const Condition ensemble{"micro.model", "ensemble"};
  return {
      {.key = "micro.domain",
       .kind = Kind::choice,
       .choices = {"shear-box", "channel", "geometry"},
       .default_value = "shear-box",
       .applies_when = {ensemble},
       .sentence =
           "Periodic box in simple shear, channel between two walls, or the geometry of a flow "
           "with inlet and outlets (micro.flow); coupled scenes need the shear box."},
      of_closed_domain(
          count_of_ensemble("micro.cells", between(1, 1000000), "24", "Number of cells.")),
      count_of_ensemble("micro.nodes", between(8, 1000), "40", "Nodes of the membrane of a cell."),
      of_closed_domain(of_ensemble("micro.aspect_ratio", "", between(0.2, 50), "1",
                                   "Length of the shear box over its height.")),
      of_lone_run("micro.shear_rate", "1/s", {{"micro.domain", "shear-box"}},
                  "Shear rate of the box."),
      of_lone_run("micro.mean_velocity", "m/s", {{"micro.domain", "channel"}},
                  "Mean velocity of the plane Poiseuille flow in the channel."),
      of_lone_run("micro.duration", "s", {}, "Time that is simulated."),
      of_lone_run("micro.output_interval", "s", {}, "Time between rows of the series."),
      {.key = "micro.time_step",
       .kind = Kind::quantity,
       .unit = "s",
       .range = above(0),
       .default_note = "0.8 of the explicit limit; with implicit steps 3e-4 over the largest "
                       "shear rate",
       .applies_when = {ensemble},
       .sentence = "Time step of the micro model."},
      {.key = "micro.force",
       .kind = Kind::boolean,
       .default_value = "false",
       .applies_when = {ensemble},
       .sentence = "Run although a stability limit is exceeded."},
      {.key = "micro.channel.height",
       .kind = Kind::quantity,
       .unit = "m",
       .range = above(0),
       .required = true,
       .applies_when = {ensemble, {"micro.domain", "channel"}},
       .sentence = "Distance between the two walls of the micro channel."},
  };
}

std::vector<Parameter> cell_parameters() {
  Parameter aspect = of_ensemble("micro.shape.aspect", "", between(0.1, 1), "0.35",
                                 "Thickness of the ellipse over its length.");
  aspect.applies_when.push_back({"micro.shape.outline", "ellipse"});
  Parameter reduced_area = of_ensemble("micro.shape.reduced_area", "", between(0.28, 0.99), "0.30",
                                       "Area of the deflated outline over that of the circle of "
                                       "its perimeter.");
  reduced_area.applies_when.push_back({"micro.shape.outline", "deflated"});
  return {
      choice_of_ensemble("micro.shape.outline", {"evans-fung", "ellipse", "deflated"}, "evans-fung",
                         "Outline of a cell: biconcave (Evans and Fung 1972), an ellipse, or a "
                         "circle deflated at constant perimeter."),
      of_ensemble("micro.shape.length", "m", above(0), "7.82 um", "Length of a cell at rest."),
      aspect,
      reduced_area,
      of_ensemble("micro.membrane.stretch_modulus", "N/m", above(0), "5e-6 N/m",
                  "Resistance of the membrane to stretching, per unit depth."),
      of_ensemble("micro.membrane.bending_modulus", "J", at_least(0), "2e-19 J",
                  "Resistance of the membrane to bending, per unit depth times length."),
      choice_of_ensemble(
          "micro.membrane.bending_law", {"turning-angle", "half-angle-tangent"}, "turning-angle",
          "Bending energy in the turning angle at a node, or in the tangent of half of "
          "it (Tsubota et al. 2006)."),
      choice_of_ensemble("micro.membrane.natural_shape", {"flat", "outline"}, "outline",
                         "Shape in which the bending energy vanishes."),
      of_ensemble("micro.membrane.area_modulus", "Pa", above(0), "50 Pa",
                  "Pressure inside a cell per relative change of its area."),
  };
}

std::vector<Parameter> run_parameters() {
  const auto number = [](const std::string& key, Range range, const std::string& value,
                         const std::string& sentence) {
    return Parameter{.key = key,
                     .kind = Kind::number,
                     .range = range,
                     .default_value = value,
                     .sentence = sentence};
  };
  Parameter longest = number("micro.run.maximum_strain", above(0), "200",
                             "Strain after the warm-up at which a micro run ends in any case.");
  longest.exceeds = Order{"micro.run.minimum_strain", true};
  return {
      number("micro.run.warm_up_strain", at_least(0), "10",
             "Strain at the beginning of a micro run that is not averaged."),
      number("micro.run.minimum_strain", at_least(0), "20",
             "Strain after the warm-up that is averaged at least."),
      longest,
      number("micro.run.relative_standard_error",
             {.lowest = 0, .highest = 1, .lowest_allowed = false, .highest_allowed = false}, "0.02",
             "A micro run ends when the standard error of its viscosity over its mean is below."),
  };
}

std::vector<Parameter> synthetic_parameters() {
  const std::vector<Condition> synthetic = {{"micro.model", "synthetic"}};
  std::vector<Parameter> table = {
      {.key = "micro.synthetic.law",
       .kind = Kind::choice,
       .choices = law_names(),
       .default_value = "newtonian",
       .applies_when = synthetic,
       .sentence = "The law that the synthetic micro model obeys."},
      {.key = "micro.synthetic.noise",
       .kind = Kind::number,
       .range = at_least(0),
       .default_value = "0.05",
       .applies_when = synthetic,
       .sentence = "Standard deviation of the stress over its mean."},
      {.key = "micro.synthetic.correlation_strain",
       .kind = Kind::number,
       .range = above(0),
       .default_value = "1",
       .applies_when = synthetic,
       .sentence = "Strain over which the noise forgets its past."},
  };
  const std::vector<Parameter> laws = law_parameters("micro.synthetic", "micro.synthetic.law");
  table.insert(table.end(), laws.begin(), laws.end());
  return table;
}

}  // namespace

std::vector<Parameter> micro_parameters() {
  std::vector<Parameter> table;
  for (const auto& part :
       {domain_parameters(), ensemble_flow_parameters(), ensemble_scheme_parameters(),
        cell_parameters(), ensemble_force_parameters(), run_parameters(), plasma_parameters(),
        cell_in_plasma_parameters(), synthetic_parameters()}) {
    table.insert(table.end(), part.begin(), part.end());
  }
  return table;
}

}  // namespace hemoscale::coupling
