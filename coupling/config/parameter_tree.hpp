#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace hemoscale::coupling {

/// Where a value stands in the user's files.
struct Location {
  std::string file;
  int line = 0;    // 1-based; 0 if unknown
  int column = 0;  // 1-based; 0 if unknown
};

/// A case as it was written, before its meaning is known: tables, lists and scalars with their
/// places. Filled from case.toml (read_toml) or from an OpenFOAM dictionary (by the plug-in); what
/// follows does not know which.
///
/// C++17-clean: the OpenFOAM plug-in includes it.
struct ParameterTree {
  enum class Kind { table, list, scalar };
  using Scalar = std::variant<bool, std::int64_t, double, std::string>;

  Kind kind = Kind::table;
  Location location;
  Scalar scalar = false;                                        // if kind is scalar
  std::vector<ParameterTree> elements;                          // if kind is list
  std::vector<std::pair<std::string, ParameterTree>> children;  // if kind is table, in file order

  /// The child of that name, or null.
  const ParameterTree* find(const std::string& name) const;
  ParameterTree* find(const std::string& name);
};

}  // namespace hemoscale::coupling
