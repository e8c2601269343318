#include "coupling/config/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "coupling/config/read_value.hpp"

namespace hemoscale::coupling {

namespace {

using Tree = ParameterTree;

constexpr std::size_t longest_key = 200;  // [-] bytes; each dot is a level of the tree

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7f;
}

/// Where an override of the command line stands.
Location command_line(const std::string& key) {
  constexpr std::size_t longest = 100;  // [-] bytes
  std::string name = key.substr(0, longest);
  std::replace_if(name.begin(), name.end(), is_control, '?');
  return {"--set " + name, 0, 0};
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (is_control(c)) {
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      result += c;
    }
  }
  return result + "\"";
}

/// The shortest digits that read back as the same number; TOML tells 1.0 from 1.
std::string number_text(double value) {
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string scalar_text(const Tree::Scalar& scalar) {
  if (const auto* text = std::get_if<std::string>(&scalar)) return quoted(*text);
  if (const auto* boolean = std::get_if<bool>(&scalar)) return *boolean ? "true" : "false";
  if (const auto* integer = std::get_if<std::int64_t>(&scalar)) return fmt::format("{}", *integer);
  return number_text(std::get<double>(scalar));
}

/// Puts a value below the tables that its key names.
void insert(Tree& top, const Override& setting) {
  Tree* table = &top;
  std::size_t begin = 0;
  for (std::size_t dot = setting.key.find('.'); dot != std::string::npos;
       dot = setting.key.find('.', begin)) {
    const std::string name = setting.key.substr(begin, dot - begin);
    Tree* child = table->find(name);
    if (child == nullptr || child->kind != Tree::Kind::table) {
      Tree section;
      section.location = setting.value.location;
      table->children.emplace_back(name, std::move(section));
      child = &table->children.back().second;
    }
    table = child;
    begin = dot + 1;
  }
  table->children.emplace_back(setting.key.substr(begin), setting.value);
}

}  // namespace

Override parse_override(const std::string& text) {
  const std::size_t equals = text.find('=');
  const auto trimmed = [](const std::string& word) {
    const std::size_t begin = word.find_first_not_of(" \t");
    if (begin == std::string::npos) return std::string();
    return word.substr(begin, word.find_last_not_of(" \t") - begin + 1);
  };
  const std::string key = trimmed(text.substr(0, equals));
  const Location place = command_line(key);
  if (equals == std::string::npos || key.empty()) {
    throw CaseError({{"--set", 0, 0, "",
                      shown(text) + " is not of the form KEY=VALUE, for instance micro.cells=40 or "
                                    "\"fluid.plasma_viscosity=1.2 mPa s\""}});
  }
  const std::string value = trimmed(text.substr(equals + 1));
  if (auto tree = read_toml_value(value, place)) return {key, *std::move(tree)};
  Tree word;
  word.kind = Tree::Kind::scalar;
  word.location = place;
  word.scalar = value;
  return {key, std::move(word)};
}

std::vector<Override> parse_overrides(const std::vector<std::string>& texts) {
  std::vector<Override> overrides;
  std::vector<Fault> faults;
  for (const std::string& text : texts) {
    try {
      overrides.push_back(parse_override(text));
    } catch (const CaseError& error) {
      faults.insert(faults.end(), error.faults().begin(), error.faults().end());
    }
  }
  if (!faults.empty()) throw CaseError(std::move(faults));
  return overrides;
}

std::string override_text(const Override& setting) {
  return setting.key + "=" + toml_text(setting.value);
}

std::string toml_text(const ParameterTree& value) {
  if (value.kind == Tree::Kind::scalar) return scalar_text(value.scalar);
  std::vector<std::string> parts;
  if (value.kind == Tree::Kind::list) {
    for (const Tree& element : value.elements) parts.push_back(toml_text(element));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
  for (const auto& [name, child] : value.children) {
    parts.push_back(quoted(name) + " = " + toml_text(child));
  }
  return fmt::format("{{{}}}", fmt::join(parts, ", "));
}

ParameterTree override_tree(const std::vector<Override>& overrides, std::vector<Fault>& faults) {
  Tree top;
  for (const Override& setting : overrides) {
    const Location& place = setting.value.location;
    const auto refuse = [&](const std::string& message) {
      faults.push_back({place.file, place.line, place.column, setting.key, message});
    };
    if (setting.key.size() > longest_key) {
      refuse("is longer than any key of a case; `hemoscale reference` lists them");
    } else if (setting.key == "case.variant") {
      refuse("is set after the variant has been applied; name the variant itself (--variant NAME)");
    } else if (setting.key == "variant" || setting.key.rfind("variant.", 0) == 0) {
      refuse(
          "belongs to a variant, and is set after the variant has been applied; set the key "
          "itself, "
          "for instance micro.cells");
    } else {
      insert(top, setting);
    }
  }
  return top;
}

}  // namespace hemoscale::coupling
