#include "coupling/plugin/plugin_settings.hpp"

#include <set>

#include "Switch.H"
#include "coupling/config/read_case.hpp"
#include "coupling/error.hpp"
#include "coupling/plugin/dictionary_tree.hpp"

namespace hemoscale::coupling {
namespace {

/// Entries that OpenFOAM, or this reader, takes from the dictionary of a function object.
const std::set<std::string>& own_entries() {
  static const std::set<std::string> names = {"type",
                                              "libs",
                                              "functionObjectLibs",
                                              "region",
                                              "enabled",
                                              "log",
                                              "errors",
                                              "executeControl",
                                              "writeControl",
                                              "executeInterval",
                                              "writeInterval",
                                              "timeStart",
                                              "timeEnd",
                                              "results",
                                              "restart",
                                              "variant",
                                              "case"};
  return names;
}

std::string expanded(const Foam::dictionary& dictionary, const char* key) {
  Foam::string text;
  if (!dictionary.readIfPresent(key, text)) return {};
  text.expand(true);
  return text;
}

Foam::fileName inside(const Foam::fileName& folder, const std::string& path) {
  Foam::fileName name(path);
  if (!name.isAbsolute()) name = folder / name;
  name.clean();
  return name;
}

CaseError fault(const Foam::dictionary& dictionary, const std::string& key,
                const std::string& message) {
  Fault one;
  const ParameterTree tree = read_dictionary(dictionary, {});
  const ParameterTree* node = tree.find(key);
  one.file = tree.location.file;
  one.line = node != nullptr ? node->location.line : tree.location.line;
  one.key = key;
  one.message = message;
  return CaseError({one});
}

ParameterTree text_node(const std::string& text, const Location& location) {
  ParameterTree node;
  node.kind = ParameterTree::Kind::scalar;
  node.location = location;
  node.scalar = text;
  return node;
}

ParameterTree& table_in(ParameterTree& tree, const std::string& name) {
  if (ParameterTree* found = tree.find(name)) return *found;
  ParameterTree table;
  table.location = tree.location;
  tree.children.emplace_back(name, std::move(table));
  return tree.children.back().second;
}

/// Inside a solver there is one possible macro flow; saying so is optional.
void complete_macro(ParameterTree& tree) {
  ParameterTree& macro = table_in(tree, "macro");
  if (macro.kind != ParameterTree::Kind::table) return;  // reported by interpret()
  if (macro.find("model") == nullptr) {
    macro.children.emplace_back("model", text_node("openfoam", macro.location));
  }
  ParameterTree& openfoam = table_in(macro, "openfoam");
  if (openfoam.kind == ParameterTree::Kind::table && openfoam.find("case") == nullptr) {
    openfoam.children.emplace_back("case", text_node(".", openfoam.location));
  }
}

Settings read_settings(const Foam::dictionary& dictionary, const Foam::fileName& openfoam_case) {
  const std::string variant = expanded(dictionary, "variant");
  const bool names_a_file = dictionary.found("case") && !dictionary.isDict("case");
  if (!names_a_file) {
    std::set<std::string> left_out = own_entries();
    left_out.erase("case");  // then it is the table of case.name and the like
    ParameterTree tree = read_dictionary(dictionary, left_out);
    complete_macro(tree);
    return interpret(tree, variant);
  }
  for (const Foam::entry& entry : dictionary) {
    const std::string key = entry.keyword();
    if (own_entries().count(key) == 0) {
      throw fault(dictionary, key,
                  "stands beside 'case'; the keys of a case are read either from the file that "
                  "'case' names or from here: move this key to that file, or remove 'case'");
    }
  }
  return interpret(read_toml(std::string(inside(openfoam_case, expanded(dictionary, "case")))),
                   variant);
}

bool read_switch(const Foam::dictionary& dictionary, const char* key) {
  const std::string text = expanded(dictionary, key);
  if (text.empty()) return false;
  const Foam::Switch value(text, true);
  if (!value.valid()) {
    throw fault(dictionary, key, "is '" + text + "'; it must be yes or no");
  }
  return value;
}

}  // namespace

PluginSettings read_plugin_settings(const Foam::dictionary& dictionary,
                                    const Foam::fileName& openfoam_case) {
  PluginSettings read;
  read.settings = read_settings(dictionary, openfoam_case);
  const std::string model = read.settings.text("macro.model");
  if (model != "openfoam") {
    throw fault(dictionary, "case",
                "macro.model is " + model +
                    " in the case; inside a solver of OpenFOAM it must be "
                    "openfoam: name a variant that sets it");
  }
  const std::string results = expanded(dictionary, "results");
  read.results = inside(openfoam_case, results.empty() ? "results" : results);
  read.restart = read_switch(dictionary, "restart");
  return read;
}

}  // namespace hemoscale::coupling
