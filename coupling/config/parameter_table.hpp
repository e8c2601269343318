#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace hemoscale::coupling {

enum class ParameterKind {
  quantity,       // number with a unit, as text such as "10 um"; or an SI number
  number,         // dimensionless; "45 %" is understood too
  integer,        // whole number
  choice,         // one of a list of words
  boolean,        // true or false
  text,           // any text
  name,           // text of letters, digits, '-' and '_', at most 64 of them
  path,           // a file or folder
  quantity_list,  // list of quantities
  points          // list of points; a point is a list of three quantities
};

/// Admissible values, in SI.
struct Range {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  bool lowest_allowed = true;
  bool highest_allowed = true;

  bool contains(double value) const;
};

/// Holds if the value of `key` (a choice, or a boolean as "true" or "false") is `value`, or with
/// `differs`, if it is another one; with an empty `value`, if `key` has no value at all.
struct Condition {
  std::string key;
  std::string value;
  bool differs = false;

  friend bool operator==(const Condition& a, const Condition& b) {
    return a.key == b.key && a.value == b.value && a.differs == b.differs;
  }
};

/// "The value must exceed that of another key", e.g. a cut-off its rest distance.
struct Order {
  std::string than;
  bool or_equal = false;
};

/// One key of a case file. The table of them drives reading, checking, `hemoscale reference` and
/// docs/reference: nothing else in the project knows names, units, ranges or defaults.
struct Parameter {
  std::string key = {};  // dotted, e.g. "micro.membrane.stretch_modulus"
  ParameterKind kind = ParameterKind::text;
  std::string unit = {};  // SI, for quantities and points; empty otherwise
  Range range = {};
  std::vector<std::string> choices = {};
  std::optional<std::size_t> length = {};  // of a list: exactly so many

  /// As a user would write it. Without one the key is required or optional.
  std::optional<std::string> default_value = {};
  /// The default holds only if all of these do; otherwise the key is required.
  std::vector<Condition> default_when = {};
  /// How the program chooses the value of an optional key that is not given.
  std::string default_note = {};
  bool required = false;

  /// The key has a meaning only if all of these hold; giving it otherwise is a fault. A key whose
  /// condition refers to a key that itself does not apply does not apply either.
  std::vector<Condition> applies_when = {};
  std::optional<Order> exceeds = {};

  std::string sentence = {};  // what it means, ends with a full stop
};

/// Every key of a case, in the order in which a case file is best written.
const std::vector<Parameter>& parameter_table();

/// The entry of that key in parameter_table(), or null.
const Parameter* find_parameter(const std::string& key);

/// A value that a user might write for this key, e.g. "\"10 um\"".
std::string example_value(const Parameter& parameter);

/// The range in words with its unit, e.g. "> 0 m" or "0.2 to 50"; empty if every value is allowed.
std::string range_text(const Parameter& parameter);

/// Conditions in words, e.g. "macro.model = channel and scene.kind = coupled".
std::string conditions_text(const std::vector<Condition>& conditions);

}  // namespace hemoscale::coupling
