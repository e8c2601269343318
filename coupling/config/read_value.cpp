#include "coupling/config/read_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "coupling/config/nearest_key.hpp"

namespace hemoscale::coupling {

namespace {

using Kind = ParameterKind;
using Tree = ParameterTree;

constexpr std::string_view blanks = " \t\r\n";
constexpr std::size_t longest_name = 64;  // [-] characters; part of file names

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// The number that a text begins with, and what follows it.
struct LeadingNumber {
  double value = 0;
  std::errc error = {};  // invalid_argument: no number; result_out_of_range
  std::string rest;
};

LeadingNumber leading_number(const std::string& text) {
  const std::size_t plus = !text.empty() && text.front() == '+' ? 1 : 0;  // from_chars knows no '+'
  LeadingNumber number;
  const char* begin = text.data() + plus;
  const char* end = text.data() + text.size();
  const bool two_signs = plus == 1 && begin != end && *begin == '-';
  const auto [stop, error] = std::from_chars(begin, end, number.value);
  number.error = two_signs ? std::errc::invalid_argument : error;
  number.rest = trimmed(std::string(stop, end));
  return number;
}

std::string expected(const Parameter& parameter) {
  const std::string example = " such as " + example_value(parameter);
  switch (parameter.kind) {
    case Kind::quantity:
      return "a quantity in " + parameter.unit + example;
    case Kind::number:
      return "a number" + example;
    case Kind::integer:
      return "a whole number" + example;
    case Kind::boolean:
      return "true or false";
    case Kind::choice:
      return fmt::format("one of {}", fmt::join(parameter.choices, ", "));
    case Kind::text:
    case Kind::name:
      return "text" + example;
    case Kind::path:
      return "the path of a file or folder" + example;
    case Kind::quantity_list:
      return "a list of quantities in " + parameter.unit + example;
    case Kind::points:
      return fmt::format("a list of {}points, each a list of three lengths,{}",
                         parameter.length ? fmt::format("{} ", *parameter.length) : "", example);
  }
  return "";
}

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7f;
}

/// Numbers with an exact double: beyond, neighbouring integers cannot be told apart.
constexpr double largest_whole = 9007199254740992.0;  // [-] 2^53

}  // namespace

std::string shown(const std::string& text) {
  constexpr std::size_t longest = 60;  // [-] bytes
  std::string result = "\"";
  for (const char c : text.substr(0, longest)) result += is_control(c) ? '?' : c;
  return result + (text.size() > longest ? "...\"" : "\"");
}

std::string shown(const Tree& node) {
  if (node.kind == Tree::Kind::table) return "a section";
  if (node.kind == Tree::Kind::list) return "a list";
  if (const auto* text = std::get_if<std::string>(&node.scalar)) return shown(*text);
  if (const auto* boolean = std::get_if<bool>(&node.scalar)) return *boolean ? "true" : "false";
  if (const auto* integer = std::get_if<std::int64_t>(&node.scalar)) {
    return fmt::format("{}", *integer);
  }
  return fmt::format("{}", std::get<double>(node.scalar));
}

std::optional<Settings::Value> ValueReader::read(const Parameter& parameter, const std::string& key,
                                                 const Tree& node) {
  const auto as_value = [](auto result) -> std::optional<Settings::Value> {
    if (!result) return std::nullopt;
    return std::optional<Settings::Value>(std::in_place, *std::move(result));
  };
  switch (parameter.kind) {
    case Kind::quantity:
    case Kind::number:
      return as_value(read_real(parameter, key, node));
    case Kind::integer:
      return as_value(read_integer(parameter, key, node));
    case Kind::boolean:
      return as_value(read_boolean(parameter, key, node));
    case Kind::choice:
    case Kind::text:
    case Kind::name:
    case Kind::path:
      return as_value(read_text(parameter, key, node));
    case Kind::quantity_list:
      return as_value(read_list(parameter, key, node));
    case Kind::points:
      return as_value(read_points(parameter, key, node));
  }
  return std::nullopt;
}

std::optional<double> ValueReader::read_real(const Parameter& parameter, const std::string& key,
                                             const Tree& node) {
  if (node.kind != Tree::Kind::scalar || std::holds_alternative<bool>(node.scalar)) {
    add_wrong_type(parameter, key, node);
    return std::nullopt;
  }
  std::optional<double> value;
  if (const auto* text = std::get_if<std::string>(&node.scalar)) {
    value = read_real_text(parameter, key, node, *text);
  } else if (const auto* integer = std::get_if<std::int64_t>(&node.scalar)) {
    value = static_cast<double>(*integer);
  } else {
    value = std::get<double>(node.scalar);
  }
  if (!value || !in_range(parameter, key, node, *value)) return std::nullopt;
  return value;
}

std::optional<double> ValueReader::read_real_text(const Parameter& parameter,
                                                  const std::string& key, const Tree& node,
                                                  const std::string& text) {
  const LeadingNumber number = leading_number(trimmed(text));
  if (number.error == std::errc::invalid_argument) {
    add(key, node.location,
        shown(text) + " does not begin with a number; expected " + expected(parameter));
    return std::nullopt;
  }
  if (number.error == std::errc::result_out_of_range) {
    add(key, node.location,
        shown(text) + " is too large or too small for a computer; expected " + expected(parameter));
    return std::nullopt;
  }
  if (number.rest.empty()) return number.value;
  const std::string unit = (number.rest.front() == '/' ? "1" : "") + number.rest;
  try {
    return units_.convert(number.value, unit, parameter.unit.empty() ? "1" : parameter.unit);
  } catch (const UnitError& error) {
    add(key, node.location,
        fmt::format("the unit {} of {} {}; expected {}", shown(number.rest), shown(text),
                    error.reason, expected(parameter)));
    return std::nullopt;
  }
}

std::optional<std::int64_t> ValueReader::read_integer(const Parameter& parameter,
                                                      const std::string& key, const Tree& node) {
  if (node.kind != Tree::Kind::scalar || std::holds_alternative<bool>(node.scalar)) {
    add_wrong_type(parameter, key, node);
    return std::nullopt;
  }
  std::int64_t value = 0;
  if (const auto* integer = std::get_if<std::int64_t>(&node.scalar)) {
    value = *integer;
  } else {
    const auto* text = std::get_if<std::string>(&node.scalar);
    const std::string word = text != nullptr ? trimmed(*text) : "";
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool is_digits =
        text != nullptr && error == std::errc{} && stop == word.data() + word.size();
    if (!is_digits) {  // 1e6 and "1e6" are whole as well
      const LeadingNumber number = text != nullptr
                                       ? leading_number(word)
                                       : LeadingNumber{std::get<double>(node.scalar), {}, ""};
      const bool whole = number.error == std::errc{} && number.rest.empty() &&
                         std::abs(number.value) < largest_whole &&
                         std::trunc(number.value) == number.value;
      if (!whole) {
        add_wrong_type(parameter, key, node);
        return std::nullopt;
      }
      value = static_cast<std::int64_t>(number.value);
    }
  }
  if (!in_range(parameter, key, node, static_cast<double>(value))) return std::nullopt;
  return value;
}

std::optional<bool> ValueReader::read_boolean(const Parameter& parameter, const std::string& key,
                                              const Tree& node) {
  if (node.kind == Tree::Kind::scalar) {
    if (const auto* boolean = std::get_if<bool>(&node.scalar)) return *boolean;
    if (const auto* text = std::get_if<std::string>(&node.scalar)) {
      for (const char* word : {"true", "yes", "on"}) {
        if (*text == word) return true;
      }
      for (const char* word : {"false", "no", "off"}) {
        if (*text == word) return false;
      }
    }
  }
  add_wrong_type(parameter, key, node);
  return std::nullopt;
}

std::optional<std::string> ValueReader::read_text(const Parameter& parameter,
                                                  const std::string& key, const Tree& node) {
  const auto* text =
      node.kind == Tree::Kind::scalar ? std::get_if<std::string>(&node.scalar) : nullptr;
  if (text == nullptr) {
    add_wrong_type(parameter, key, node);
    return std::nullopt;
  }
  const auto refuse = [&](const std::string& message) {
    add(key, node.location, message);
    return std::nullopt;
  };
  if (parameter.kind == Kind::choice) {
    if (std::count(parameter.choices.begin(), parameter.choices.end(), *text) > 0) return *text;
    return refuse(fmt::format("{} is not {}; did you mean \"{}\"?", shown(*text),
                              expected(parameter), nearest_word(*text, parameter.choices)));
  }
  // Only a text that may be left out may be empty: a description, not a name or a command.
  const bool may_be_empty = parameter.default_value && parameter.default_value->empty();
  if (trimmed(*text).empty() && !may_be_empty) {
    return refuse("the text is empty; expected " + expected(parameter));
  }
  if (parameter.kind == Kind::name) {
    const bool allowed = std::all_of(text->begin(), text->end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
             c == '-' || c == '_';
    });
    if (!allowed || text->size() > longest_name) {
      return refuse(fmt::format(
          "{} is not a name: allowed are letters, digits, '-' and '_', at most {} of them; it "
          "becomes part of file names",
          shown(*text), longest_name));
    }
  }
  const auto unprintable = [](char c) { return is_control(c) && c != '\n' && c != '\t'; };
  if (std::any_of(text->begin(), text->end(), unprintable)) {
    return refuse(shown(*text) + " holds control characters; write plain text");
  }
  return *text;
}

std::optional<std::vector<double>> ValueReader::read_list(const Parameter& parameter,
                                                          const std::string& key,
                                                          const Tree& node) {
  if (!is_list_of_length(parameter, key, node)) return std::nullopt;
  Parameter element = parameter;  // the same unit and range, for messages about one element
  element.kind = Kind::quantity;
  std::vector<double> values;
  for (const Tree& entry : node.elements) {
    if (const auto value = read_real(element, key, entry)) values.push_back(*value);
  }
  if (values.size() != node.elements.size()) return std::nullopt;
  return values;
}

std::optional<Settings::Points> ValueReader::read_points(const Parameter& parameter,
                                                         const std::string& key, const Tree& node) {
  if (!is_list_of_length(parameter, key, node)) return std::nullopt;
  Parameter coordinate = parameter;
  coordinate.kind = Kind::quantity;
  Settings::Points points;
  for (std::size_t i = 0; i < node.elements.size(); ++i) {
    const Tree& entry = node.elements[i];
    if (entry.kind != Tree::Kind::list || entry.elements.size() != 3) {
      const std::string found = entry.kind == Tree::Kind::list
                                    ? fmt::format("a list of {}", entry.elements.size())
                                    : shown(entry);
      add(key, entry.location,
          fmt::format("point {} is {}; a point is a list of three lengths such as "
                      "[\"0 um\", \"5 um\", \"0 um\"]",
                      i + 1, found));
      continue;
    }
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    bool complete = true;
    for (std::size_t j = 0; j < 3; ++j) {
      const auto value = read_real(coordinate, key, entry.elements[j]);
      complete = complete && value.has_value();
      if (value) point[static_cast<Eigen::Index>(j)] = *value;
    }
    if (complete) points.push_back(point);
  }
  if (points.size() != node.elements.size()) return std::nullopt;
  return points;
}

void ValueReader::add(const std::string& key, const Location& location,
                      const std::string& message) {
  faults_.push_back({location.file, location.line, location.column, key, message});
}

bool ValueReader::is_list_of_length(const Parameter& parameter, const std::string& key,
                                    const Tree& node) {
  if (node.kind != Tree::Kind::list || node.elements.empty()) {
    add_wrong_type(parameter, key, node);
    return false;
  }
  if (!parameter.length || node.elements.size() == *parameter.length) return true;
  add(key, node.location,
      fmt::format("a list of {} is not what belongs here; expected {}", node.elements.size(),
                  expected(parameter)));
  return false;
}

void ValueReader::add_wrong_type(const Parameter& parameter, const std::string& key,
                                 const Tree& node) {
  const bool empty_list = node.kind == Tree::Kind::list && node.elements.empty();
  add(key, node.location,
      (empty_list ? "an empty list" : shown(node)) + " is not what belongs here; expected " +
          expected(parameter));
}

bool ValueReader::in_range(const Parameter& parameter, const std::string& key, const Tree& node,
                           double value) {
  if (!std::isfinite(value)) {
    add(key, node.location, shown(node) + " is not finite; expected " + expected(parameter));
    return false;
  }
  if (parameter.range.contains(value)) return true;
  Parameter alone = parameter;
  alone.exceeds.reset();  // compared with other keys later
  add(key, node.location,
      fmt::format("{}{} is out of range; allowed is {}", shown(node),
                  parameter.unit.empty() ? std::string()
                                         : fmt::format(" = {:.6g} {}", value, parameter.unit),
                  range_text(alone)));
  return false;
}

}  // namespace hemoscale::coupling
