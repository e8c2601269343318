#include "coupling/config/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "coupling/config/nearest_key.hpp"
#include "coupling/config/parameter_table.hpp"
#include "coupling/error.hpp"

namespace hemoscale::coupling {

namespace {

using Kind = ParameterKind;

constexpr std::size_t terminal_width = 80;  // [-] columns

std::string kind_text(const Parameter& parameter) {
  switch (parameter.kind) {
    case Kind::quantity:
      return "quantity in " + parameter.unit;
    case Kind::number:
      return "number";
    case Kind::integer:
      return "whole number";
    case Kind::choice:
      return fmt::format("{}", fmt::join(parameter.choices, " | "));
    case Kind::boolean:
      return "true | false";
    case Kind::text:
      return "text";
    case Kind::name:
      return "name (letters, digits, '-', '_')";
    case Kind::path:
      return "path";
    case Kind::quantity_list:
      return "list of quantities in " + parameter.unit;
    case Kind::points:
      return fmt::format("list of {}points in {}",
                         parameter.length ? fmt::format("{} ", *parameter.length) : "",
                         parameter.unit);
  }
  return "";
}

std::string default_text(const Parameter& parameter) {
  if (parameter.default_value) {
    std::string value = parameter.default_value->empty() ? "\"\"" : *parameter.default_value;
    if (parameter.default_when.empty()) return value;
    return value + " when " + conditions_text(parameter.default_when) + ", otherwise required";
  }
  if (parameter.required) return "required";
  return parameter.default_note.empty() ? "none" : parameter.default_note;
}

/// The entries of a key or of a section.
std::vector<const Parameter*> selected(const std::string& key_or_section) {
  std::vector<const Parameter*> found;
  for (const Parameter& parameter : parameter_table()) {
    const bool in_section = parameter.key.rfind(key_or_section + ".", 0) == 0;
    if (key_or_section.empty() || parameter.key == key_or_section || in_section) {
      found.push_back(&parameter);
    }
  }
  if (found.empty()) {
    throw CaseError({{"", 0, 0, key_or_section,
                      "is not a known key or section; " +
                          suggestion_text(suggest(key_or_section, parameter_table()))}});
  }
  return found;
}

/// Words of `text` in lines that begin with `indent` blanks and end before the terminal does.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::istringstream words(text);
  std::string result;
  std::string line(indent, ' ');
  for (std::string word; words >> word;) {
    const bool begins = line.size() == indent;
    if (!begins && line.size() + 1 + word.size() > terminal_width) {
      result += line + "\n";
      line = std::string(indent, ' ') + word;
    } else {
      line += (begins ? "" : " ") + word;
    }
  }
  return result + line + "\n";
}

/// Text in lines that begin in column `indent`, with a label in column `label_indent` of the first.
std::string labelled(const std::string& label, const std::string& text,
                     std::size_t label_indent = 2, std::size_t indent = 14) {
  std::string result = wrapped(text, indent);
  result.replace(label_indent, label.size(), label);
  return result;
}

std::string card(const Parameter& parameter) {
  std::string text = parameter.key + "\n" + wrapped(parameter.sentence, 2) + "\n";
  text += labelled("kind", kind_text(parameter));
  const std::string range = range_text(parameter);
  if (!range.empty()) text += labelled("allowed", range);
  text += labelled("default", default_text(parameter));
  if (!parameter.applies_when.empty()) {
    text += labelled("applies", "when " + conditions_text(parameter.applies_when));
  }
  const std::size_t dot = parameter.key.rfind('.');
  text += labelled("example", fmt::format("[{}] {} = {}", parameter.key.substr(0, dot),
                                          parameter.key.substr(dot + 1), example_value(parameter)));
  return text;
}

std::string section_of(const Parameter& parameter) {
  return parameter.key.substr(0, parameter.key.rfind('.'));
}

std::string name_in_section(const Parameter& parameter) {
  return parameter.key.substr(parameter.key.rfind('.') + 1);
}

std::string escaped(std::string text) {
  for (std::size_t i = text.find('|'); i != std::string::npos; i = text.find('|', i + 2)) {
    text.insert(i, "\\");
  }
  return text;
}

std::string code(const std::string& text) {
  return "`" + text + "`";
}

/// Condition common to every key of a section, told once instead of in every row.
std::vector<Condition> shared_conditions(const std::vector<const Parameter*>& section) {
  std::vector<Condition> shared = section.front()->applies_when;
  for (const Parameter* parameter : section) {
    const auto missing = [&](const Condition& condition) {
      return std::none_of(parameter->applies_when.begin(), parameter->applies_when.end(),
                          [&](const Condition& other) { return other == condition; });
    };
    shared.erase(std::remove_if(shared.begin(), shared.end(), missing), shared.end());
  }
  return shared;
}

std::string section_markdown(const std::vector<const Parameter*>& section) {
  const std::vector<Condition> shared = shared_conditions(section);
  std::string text = "## " + section_of(*section.front()) + "\n\n";
  if (!shared.empty()) text += "Applies when " + conditions_text(shared) + ".\n\n";
  text += "| key | value | allowed | default | meaning |\n|---|---|---|---|---|\n";
  for (const Parameter* parameter : section) {
    std::vector<Condition> own;
    for (const Condition& condition : parameter->applies_when) {
      const bool told = std::any_of(shared.begin(), shared.end(),
                                    [&](const Condition& other) { return other == condition; });
      if (!told) own.push_back(condition);
    }
    std::string meaning = parameter->sentence;
    if (!own.empty()) meaning += " Applies when " + conditions_text(own) + ".";
    text += fmt::format("| {} | {} | {} | {} | {} |\n", code(name_in_section(*parameter)),
                        escaped(kind_text(*parameter)), range_text(*parameter),
                        escaped(default_text(*parameter)), escaped(meaning));
  }
  return text;
}

constexpr const char* introduction =
    "# Keys of a case file\n"
    "\n"
    "Generated by `hemoscale reference --markdown`; do not edit. A test compares the two.\n"
    "\n"
    "A case file is `case.toml` in the folder of the case. Section and key together make the full\n"
    "name: `height` in `[macro.channel]` is `macro.channel.height`.\n"
    "\n"
    "- A **quantity** is text with a unit, such as `\"10 um\"`, `\"1.2 mPa s\"` or `\"100 1/s\"`, "
    "or a\n"
    "  number in the SI unit given. Units are those of UDUNITS-2, besides `P` (poise) and `dyn`.\n"
    "  Only proportional units are accepted: no `degC`.\n"
    "- A **number** has no unit; `\"45 %\"` is 0.45.\n"
    "- A **list of points** is a list of lists of three lengths.\n"
    "- A key that does not apply to the models that were chosen is a fault, like an unknown one.\n"
    "- `[variant.NAME]` holds keys in the same layout, which replace those of the case when that\n"
    "  variant is chosen (`--variant NAME`, or `case.variant`). If a variant switches to another\n"
    "  model, the keys of the case for the first one rest. All variants are checked key by key;\n"
    "  whether keys apply or are missing is checked for the chosen one.\n"
    "- In an OpenFOAM dictionary the keys are the same; sections are sub-dictionaries, and words\n"
    "  such as `yes` and `off` are booleans.\n";

}  // namespace

std::string reference_text(const std::string& key_or_section) {
  const std::vector<const Parameter*> found = selected(key_or_section);
  if (found.size() == 1 && found.front()->key == key_or_section) return card(*found.front());
  std::string text;
  std::string section;
  for (const Parameter* parameter : found) {
    if (section_of(*parameter) != section) {
      section = section_of(*parameter);
      text += (text.empty() ? "[" : "\n[") + section + "]\n";
    }
    text += labelled(name_in_section(*parameter), default_text(*parameter), 0, 28);
    text += wrapped(parameter->sentence, 28);
  }
  return text + "\nEach key in full: hemoscale reference KEY\n";
}

std::string reference_markdown(const std::string& key_or_section) {
  std::string text = key_or_section.empty() ? introduction : "";
  std::vector<const Parameter*> section;
  const auto flush = [&] {
    if (section.empty()) return;
    text += (text.empty() ? "" : "\n") + section_markdown(section);
    section.clear();
  };
  for (const Parameter* parameter : selected(key_or_section)) {
    if (!section.empty() && section_of(*section.front()) != section_of(*parameter)) flush();
    section.push_back(parameter);
  }
  flush();
  return text;
}

}  // namespace hemoscale::coupling
