#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "coupling/config/parameter_table.hpp"
#include "coupling/config/parameter_tree.hpp"
#include "coupling/config/read_value.hpp"
#include "coupling/config/settings.hpp"
#include "coupling/error.hpp"

namespace hemoscale::coupling {

/// One key as the user gave it.
struct Given {
  std::optional<Settings::Value> value;  // none if it was faulty
  Location location;
  std::string written_key;  // as the user wrote it, with "variant.NAME." in a variant
};

/// What one layer of a case (the case itself, or one variant) says.
struct Layer {
  std::map<std::string, Given> values;        // by key
  std::map<std::string, Location> sections;   // that occur, by name, e.g. "micro.membrane"
  std::set<std::string> probably_misspelled;  // keys nearest to an unknown one
};

/// The case itself and its variants, each value checked on its own.
struct Layers {
  Layer base;
  std::vector<std::pair<std::string, Layer>> variants;  // in file order
};

/// Looks up every key of the tree in the table and reads its value. Knows nothing of which keys
/// apply or are missing.
///
/// @param reader  adds its faults to `faults`
Layers collect_values(const ParameterTree& tree, const std::vector<Parameter>& table,
                      ValueReader& reader, std::vector<Fault>& faults);

}  // namespace hemoscale::coupling
