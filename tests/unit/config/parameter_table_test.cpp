#include "coupling/config/parameter_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "coupling/config/read_value.hpp"

namespace hemoscale::coupling {
namespace {

using Kind = ParameterKind;

TEST(ParameterTable, keys_are_unique_and_well_formed) {
  std::set<std::string> keys;
  for (const Parameter& parameter : parameter_table()) {
    EXPECT_TRUE(keys.insert(parameter.key).second) << parameter.key;
    EXPECT_EQ(parameter.key.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_."),
              std::string::npos)
        << parameter.key;
    EXPECT_NE(parameter.key.find('.'), std::string::npos) << parameter.key;
    EXPECT_EQ(find_parameter(parameter.key), &parameter);
    ASSERT_FALSE(parameter.sentence.empty()) << parameter.key;
    EXPECT_EQ(parameter.sentence.back(), '.') << parameter.key;
  }
  EXPECT_EQ(find_parameter("no.such.key"), nullptr);
  EXPECT_GT(keys.size(), 100U);
}

TEST(ParameterTable, no_key_is_a_section_too) {
  for (const Parameter& a : parameter_table()) {
    for (const Parameter& b : parameter_table()) {
      EXPECT_NE(b.key.rfind(a.key + ".", 0), 0U) << a.key << " and " << b.key;
    }
  }
}

TEST(ParameterTable, every_default_and_example_is_valid) {
  for (const Parameter& parameter : parameter_table()) {
    std::vector<Fault> faults;
    ValueReader reader(faults);
    if (parameter.default_value) {
      ParameterTree written;
      written.kind = ParameterTree::Kind::scalar;
      written.scalar = *parameter.default_value;
      EXPECT_TRUE(reader.read(parameter, parameter.key, written)) << parameter.key;
      EXPECT_FALSE(parameter.required) << parameter.key;
    }
    for (const Fault& fault : faults) ADD_FAILURE() << fault.key << ": " << fault.message;
    EXPECT_FALSE(example_value(parameter).empty()) << parameter.key;
  }
}

TEST(ParameterTable, units_are_si) {
  const UnitSystem units;
  for (const Parameter& parameter : parameter_table()) {
    const bool has_unit = parameter.kind == Kind::quantity || parameter.kind == Kind::points ||
                          parameter.kind == Kind::quantity_list;
    EXPECT_EQ(has_unit, !parameter.unit.empty()) << parameter.key;
    if (has_unit) {
      EXPECT_EQ(units.convert(1, parameter.unit, parameter.unit), 1) << parameter.key;
    }
    EXPECT_EQ(parameter.kind == Kind::choice, !parameter.choices.empty()) << parameter.key;
  }
}

/// Conditions name a choice or boolean that stands earlier (hence no cycles) and a value it can
/// have.
TEST(ParameterTable, conditions_can_hold) {
  std::set<std::string> earlier;
  for (const Parameter& parameter : parameter_table()) {
    std::vector<Condition> conditions = parameter.applies_when;
    conditions.insert(conditions.end(), parameter.default_when.begin(),
                      parameter.default_when.end());
    for (const Condition& condition : conditions) {
      ASSERT_EQ(earlier.count(condition.key), 1U) << parameter.key << ": " << condition.key;
      const Parameter& chooser = *find_parameter(condition.key);
      if (condition.value.empty()) continue;
      const std::vector<std::string> values = chooser.kind == Kind::boolean
                                                  ? std::vector<std::string>{"true", "false"}
                                                  : chooser.choices;
      EXPECT_EQ(std::count(values.begin(), values.end(), condition.value), 1)
          << parameter.key << ": " << condition.key << " = " << condition.value;
    }
    if (parameter.exceeds) {
      const Parameter* other = find_parameter(parameter.exceeds->than);
      ASSERT_NE(other, nullptr) << parameter.key;
      EXPECT_EQ(other->unit, parameter.unit) << parameter.key;
    }
    earlier.insert(parameter.key);
  }
}

TEST(ParameterTable, synthetic_laws_have_the_parameters_of_the_initial_law) {
  const std::string from = "law.";
  const std::string to = "micro.synthetic.";
  int count = 0;
  for (const Parameter& parameter : parameter_table()) {
    if (parameter.key.rfind(from, 0) != 0 || parameter.key == "law.initial") continue;
    const Parameter* twin = find_parameter(to + parameter.key.substr(from.size()));
    ASSERT_NE(twin, nullptr) << parameter.key;
    EXPECT_EQ(twin->default_value, parameter.default_value);
    EXPECT_EQ(twin->unit, parameter.unit);
    ++count;
  }
  EXPECT_EQ(count, 20);
}

TEST(ParameterTable, ranges_in_words) {
  Parameter parameter{.kind = Kind::quantity, .unit = "m"};
  EXPECT_EQ(range_text(parameter), "");
  parameter.range = {.lowest = 0, .lowest_allowed = false};
  EXPECT_EQ(range_text(parameter), "> 0 m");
  parameter.range.highest = 2;
  EXPECT_EQ(range_text(parameter), "> 0 and <= 2 m");
  parameter.range = {.lowest = 1, .highest = 2};
  EXPECT_EQ(range_text(parameter), "1 to 2 m");
  parameter.range = {.highest = 2, .highest_allowed = false};
  parameter.exceeds = Order{"other.key"};
  EXPECT_EQ(range_text(parameter), "< 2 m and > other.key");
}

}  // namespace
}  // namespace hemoscale::coupling
