#include <utility>

#include "coupling/config/parameter_sections.hpp"

namespace hemoscale::coupling {

using Kind = ParameterKind;

namespace {

struct Law {
  std::string name;     // as a chooser writes it
  std::string section;  // of its parameters
  std::vector<Parameter> parameters;
};

Parameter viscosity(const std::string& name, std::optional<std::string> value,
                    const std::string& sentence) {
  return {.key = name,
          .kind = Kind::quantity,
          .unit = "Pa s",
          .range = above(0),
          .default_value = std::move(value),
          .sentence = sentence};
}

Parameter shear_rate(const std::string& name, std::optional<std::string> value,
                     const std::string& sentence) {
  Parameter parameter = viscosity(name, std::move(value), sentence);
  parameter.unit = "1/s";
  return parameter;
}

Parameter time_scale(std::optional<std::string> value, const std::string& sentence) {
  Parameter parameter = viscosity("time", std::move(value), sentence);
  parameter.unit = "s";
  return parameter;
}

Parameter number(const std::string& name, Range range, std::optional<std::string> value,
                 const std::string& sentence) {
  return {.key = name,
          .kind = Kind::number,
          .range = range,
          .default_value = std::move(value),
          .sentence = sentence};
}

Law carreau_yasuda() {
  Parameter lower = viscosity("infinite_viscosity", "3.45 mPa s", "At infinite shear rate.");
  lower.range = at_least(0);
  return {"carreau-yasuda",
          "carreau_yasuda",
          {viscosity("zero_viscosity", "0.056 Pa s",
                     "At rest; the defaults of this law are those of Cho and Kensey (1991)."),
           lower, time_scale("3.313 s", "Thinning begins at the shear rate 1/time."),
           number("power", between(0, 1), "0.3568", "Power-law index n of the thinning branch."),
           number("transition", above(0), "2", "Sharpness a of the first bend.")}};
}

Law casson() {
  const Parameter yield_stress = {
      .key = "yield_stress",
      .kind = Kind::quantity,
      .unit = "Pa",
      .range = at_least(0),
      .default_value = "5 mPa",
      .sentence = "Stress below which the law does not flow; zero makes it Newtonian."};
  return {"casson",
          "casson",
          {yield_stress, viscosity("viscosity", "3.5 mPa s", "At infinite shear rate."),
           shear_rate("lowest_shear_rate", "1e-3 1/s",
                      "The law is held constant below it, where it would grow without bound.")}};
}

Law cross() {
  Parameter lower = viscosity("infinite_viscosity", {}, "At infinite shear rate.");
  lower.range = at_least(0);
  return {"cross",
          "cross",
          {viscosity("zero_viscosity", {}, "At rest."), lower,
           time_scale({}, "Half of the fall is reached at the shear rate 1/time."),
           number("power", above(0), {}, "Exponent m of time times shear rate.")}};
}

Law power_law() {
  Parameter highest = shear_rate("highest_shear_rate", {}, "The law is held constant above it.");
  highest.exceeds = Order{"lowest_shear_rate"};
  return {"power-law",
          "power_law",
          {viscosity("consistency", {}, "Viscosity at the shear rate 1 1/s."),
           number("power", above(0), {},
                  "Index n: the stress grows with the n-th power of the shear rate."),
           shear_rate("lowest_shear_rate", {}, "The law is held constant below it."), highest}};
}

Law quemada() {
  return {
      "quemada",
      "quemada",
      {number("packing_low", at_least(0), "4.33", "Intrinsic viscosity k0 at low shear rate."),
       number("packing_high", at_least(0), "2.07", "Intrinsic viscosity k_inf at high shear rate."),
       shear_rate(
           "critical_shear_rate", "1.88 1/s",
           "Shear rate at which the two weigh the same; plasma viscosity and hematocrit come "
           "from the fluid.")}};
}

std::vector<Law> laws() {
  return {
      {"newtonian", "newtonian", {viscosity("viscosity", "3.5 mPa s", "The constant viscosity.")}},
      carreau_yasuda(),
      casson(),
      cross(),
      power_law(),
      quemada()};
}

}  // namespace

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const Law& law : laws()) names.push_back(law.name);
  return names;
}

std::vector<Parameter> law_parameters(const std::string& section, const std::string& chooser) {
  std::vector<Parameter> table;
  for (const Law& law : laws()) {
    for (Parameter parameter : law.parameters) {
      parameter.key = section + "." + law.section + "." + parameter.key;
      parameter.required = !parameter.default_value;
      parameter.applies_when = {{chooser, law.name}};
      if (parameter.exceeds) {
        parameter.exceeds->than = section + "." + law.section + "." + parameter.exceeds->than;
      }
      table.push_back(parameter);
    }
  }
  return table;
}

}  // namespace hemoscale::coupling
