// toml++ is seen by this file alone: it is large, and only the tree leaves.
//
// Some broken input reaches an assertion of its parser (version 3.3: "[.a]"), which ends the
// process, or in an optimised build is taken for a promise to the compiler. Here a failed assertion
// of toml++ is an exception in every build, and the input is refused.
#undef NDEBUG
namespace {
struct ParserAssertion {};
[[noreturn]] void refuse_input() {
  throw ParserAssertion{};
}
}  // namespace
#define TOML_HEADER_ONLY 1
#define TOML_ASSERT(expression) ((expression) ? static_cast<void>(0) : refuse_input())
#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include "coupling/config/read_case.hpp"
#include "coupling/error.hpp"

namespace hemoscale::coupling {

namespace {

constexpr std::uintmax_t largest_file = 4U << 20U;  // [bytes] a case file is text written by hand
constexpr std::size_t most_key_dots = 2000;         // [-]

Location location_of(const std::string& file, const toml::source_region& region) {
  return {file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

Fault fault_at(const Location& location, const std::string& message) {
  return {location.file, location.line, location.column, "", message};
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Tables nest as deep as a dotted key has dots, and toml++ walks them recursively without a limit:
/// some 10^5 dots overflow its stack (seen with version 3.3). Dots inside numbers do not count.
/// @returns the place where the number of dots exceeds what a case may hold; line 0 if it does not
Location place_of_too_many_dots(const std::string& file, const std::string& text) {
  std::size_t dots = 0;
  bool word_has_dot = false;  // a number has one dot, a dotted key of digits may have more
  Location place{file, 1, 1};
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '.') {
      const bool between_digits =
          i > 0 && is_digit(text[i - 1]) && i + 1 < text.size() && is_digit(text[i + 1]);
      if (!between_digits || word_has_dot) ++dots;
      if (dots > most_key_dots) return place;
      word_has_dot = true;
    } else if (std::strchr(" \t\r\n,[]{}=\"'#", c) != nullptr) {
      word_has_dot = false;
    }
    ++place.column;
    if (c == '\n') {
      ++place.line;
      place.column = 1;
    }
  }
  return {file, 0, 0};
}

std::string system_reason() {
  return std::strerror(errno);
}

std::string read_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    throw EnvironmentError("cannot read " + file.string() +
                           ": no such file; a case is a folder with a file case.toml");
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw EnvironmentError("cannot read " + file.string() +
                           ": not a file; a case is a folder with a file case.toml");
  }
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw EnvironmentError("cannot read " + file.string() + ": " + system_reason());
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (!error && size > largest_file) {
    throw CaseError({{file.string(), 0, 0, "",
                      "the file has " + std::to_string(size) + " bytes; a case file has at most " +
                          std::to_string(largest_file) + ": is it a case file?"}});
  }
  std::ostringstream text;
  text << stream.rdbuf();
  if (stream.bad() || (size > 0 && !text)) {
    throw EnvironmentError("cannot read " + file.string() + ": " + system_reason());
  }
  return text.str();
}

/// Dates and times, which no key wants, become the text that was written: the parameter table then
/// says what belongs there.
ParameterTree::Scalar scalar_of(const toml::node& node) {
  if (const auto* value = node.as_boolean()) return value->get();
  if (const auto* value = node.as_integer()) return value->get();
  if (const auto* value = node.as_floating_point()) return value->get();
  if (const auto* value = node.as_string()) return value->get();
  std::ostringstream text;
  if (const auto* date = node.as_date()) text << date->get();
  if (const auto* time = node.as_time()) text << time->get();
  if (const auto* both = node.as_date_time()) text << both->get();
  return text.str();
}

ParameterTree make_tree(const std::string& file, const toml::node& node) {
  ParameterTree tree;
  tree.location = location_of(file, node.source());
  if (const auto* table = node.as_table()) {
    tree.kind = ParameterTree::Kind::table;
    for (const auto& [key, child] : *table) {
      tree.children.emplace_back(std::string(key.str()), make_tree(file, child));
      // A section stands where its name does.
      ParameterTree& made = tree.children.back().second;
      if (made.kind == ParameterTree::Kind::table) {
        made.location = location_of(file, key.source());
      }
    }
    // toml++ sorts by name; the user wrote in another order.
    std::stable_sort(tree.children.begin(), tree.children.end(), [](const auto& a, const auto& b) {
      return std::pair(a.second.location.line, a.second.location.column) <
             std::pair(b.second.location.line, b.second.location.column);
    });
  } else if (const auto* array = node.as_array()) {
    tree.kind = ParameterTree::Kind::list;
    for (const toml::node& element : *array) tree.elements.push_back(make_tree(file, element));
  } else {
    tree.kind = ParameterTree::Kind::scalar;
    tree.scalar = scalar_of(node);
  }
  return tree;
}

/// The line at which toml++ fails an assertion, found by reading ever longer beginnings.
Location place_of_assertion(const std::string& file, const std::string& text) {
  constexpr int most_lines = 1000;  // the cost grows with the square
  Location place{file, 0, 0};
  std::size_t end = 0;
  for (int line = 1; line <= most_lines && end < text.size(); ++line) {
    end = std::min(text.find('\n', end), text.size() - 1) + 1;
    try {
      static_cast<void>(toml::parse(std::string_view(text).substr(0, end), std::string_view(file)));
    } catch (const toml::parse_error&) {
      continue;  // what is cut off in the middle is no news
    } catch (const ParserAssertion&) {
      place.line = line;
      return place;
    }
  }
  return place;
}

/// Every part of a value stands where the whole was set.
void place_at(const Location& location, ParameterTree& tree) {
  tree.location = location;
  for (ParameterTree& element : tree.elements) place_at(location, element);
  for (auto& [name, child] : tree.children) place_at(location, child);
}

}  // namespace

std::optional<ParameterTree> read_toml_value(const std::string& text, const Location& location) {
  const std::string line = "value = " + text;
  if (place_of_too_many_dots("", line).line > 0) return std::nullopt;
  try {
    const toml::table table = toml::parse(std::string_view(line));
    if (table.size() != 1) return std::nullopt;  // further lines with keys of their own
    ParameterTree tree = make_tree("", *table.get("value"));
    place_at(location, tree);
    return tree;
  } catch (const toml::parse_error&) {
    return std::nullopt;
  } catch (const ParserAssertion&) {
    return std::nullopt;
  }
}

ParameterTree read_toml(const std::filesystem::path& file) {
  const std::string name = file.string();
  const std::string text = read_file(file);
  const Location too_deep = place_of_too_many_dots(name, text);
  if (too_deep.line > 0) {
    throw CaseError({fault_at(too_deep, "more than " + std::to_string(most_key_dots) +
                                            " dots outside of numbers up to here; no case nests "
                                            "that deep: is it a case file?")});
  }
  try {
    const toml::table table = toml::parse(std::string_view(text), std::string_view(name));
    ParameterTree tree = make_tree(name, table);
    tree.location = {name, 0, 0};  // the file as a whole
    return tree;
  } catch (const toml::parse_error& error) {
    throw CaseError({fault_at(location_of(name, error.source()),
                              std::string("not valid TOML: ") + std::string(error.description()) +
                                  "; text stands in quotes, sections in brackets")});
  } catch (const ParserAssertion&) {
    throw CaseError({fault_at(place_of_assertion(name, text),
                              "not valid TOML: a section begins with what cannot begin a name; "
                              "write for example [micro.membrane]")});
  }
}

}  // namespace hemoscale::coupling
