#include "coupling/config/parameter_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "coupling/config/parameter_sections.hpp"

namespace hemoscale::coupling {

namespace {

using Index = std::unordered_map<std::string, const Parameter*>;

std::vector<Parameter> join_sections() {
  std::vector<Parameter> table;
  for (const auto& section : {case_parameters(), macro_parameters(), loop_parameters(),
                              micro_parameters(), output_parameters()}) {
    table.insert(table.end(), section.begin(), section.end());
  }
  return table;
}

Index index_of(const std::vector<Parameter>& table) {
  Index index;
  for (const Parameter& parameter : table) index.emplace(parameter.key, &parameter);
  return index;
}

/// Something of everyday size in the field, for keys that have no default to show.
std::string example_quantity(const std::string& unit) {
  static const std::unordered_map<std::string, std::string> examples = {
      {"m", "10 um"},   {"m/s", "1 mm/s"},        {"s", "10 ms"},        {"1/s", "100 1/s"},
      {"Pa", "5 mPa"},  {"Pa/m", "10 kPa/m"},     {"Pa s", "3.5 mPa s"}, {"N/m", "5 uN/m"},
      {"J", "2e-19 J"}, {"kg/m^3", "1050 kg/m^3"}};
  const auto example = examples.find(unit);
  return example == examples.end() ? "1 " + unit : example->second;
}

std::string with_unit(double value, const std::string& unit) {
  return fmt::format("{}{}{}", value, unit.empty() ? "" : " ", unit);
}

}  // namespace

bool Range::contains(double value) const {
  if (std::isnan(value)) return false;
  const bool above_lowest = lowest_allowed ? value >= lowest : value > lowest;
  const bool below_highest = highest_allowed ? value <= highest : value < highest;
  return above_lowest && below_highest;
}

const std::vector<Parameter>& parameter_table() {
  static const std::vector<Parameter> table = join_sections();
  return table;
}

const Parameter* find_parameter(const std::string& key) {
  static const Index index = index_of(parameter_table());
  const auto entry = index.find(key);
  return entry == index.end() ? nullptr : entry->second;
}

std::string example_value(const Parameter& parameter) {
  const std::string& given = parameter.default_value.value_or("");
  switch (parameter.kind) {
    case ParameterKind::quantity:
      return '"' + (given.empty() ? example_quantity(parameter.unit) : given) + '"';
    case ParameterKind::number:
      return given.empty() ? "0.4" : given;
    case ParameterKind::integer:
      return given.empty() ? "10" : given;
    case ParameterKind::boolean:
      return given.empty() ? "true" : given;
    case ParameterKind::choice:
      return '"' + (given.empty() ? parameter.choices.front() : given) + '"';
    case ParameterKind::text:
    case ParameterKind::name:
      return '"' + (given.empty() ? "a-name" : given) + '"';
    case ParameterKind::path:
      return "\"a-folder\"";
    case ParameterKind::quantity_list:
      return "[\"" + example_quantity(parameter.unit) + "\"]";
    case ParameterKind::points:
      return parameter.length == 2
                 ? "[[\"0 um\", \"0 um\", \"0 um\"], [\"0 um\", \"80 um\", \"0 um\"]]"
                 : "[[\"0 um\", \"5 um\", \"0 um\"]]";
  }
  return "";
}

std::string range_text(const Parameter& parameter) {
  const Range& range = parameter.range;
  const bool has_lowest = std::isfinite(range.lowest);
  const bool has_highest = std::isfinite(range.highest);
  const std::string lowest = with_unit(range.lowest, has_highest ? "" : parameter.unit);
  const std::string highest = with_unit(range.highest, parameter.unit);
  const std::string low = (range.lowest_allowed ? ">= " : "> ") + lowest;
  const std::string high = (range.highest_allowed ? "<= " : "< ") + highest;
  std::string text;
  if (has_lowest && has_highest) {
    const bool closed = range.lowest_allowed && range.highest_allowed;
    text = closed ? lowest + " to " + highest : low + " and " + high;
  } else if (has_lowest) {
    text = low;
  } else if (has_highest) {
    text = high;
  }
  if (parameter.exceeds) {
    if (!text.empty()) text += " and ";
    text += (parameter.exceeds->or_equal ? ">= " : "> ") + parameter.exceeds->than;
  }
  return text;
}

std::string conditions_text(const std::vector<Condition>& conditions) {
  std::string text;
  for (const Condition& condition : conditions) {
    if (!text.empty()) text += " and ";
    text += condition.value.empty()
                ? condition.key + " is not given"
                : condition.key + (condition.differs ? " is not " : " = ") + condition.value;
  }
  return text;
}

}  // namespace hemoscale::coupling
