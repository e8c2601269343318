#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "coupling/config/parameter_tree.hpp"

namespace hemoscale::coupling {

/// A case whose every value has been checked against the parameter table: SI numbers, known
/// choices, defaults filled in. Asking for a key that the table does not hold is a bug (assertion).
///
/// C++17-clean: the OpenFOAM plug-in includes it.
class Settings {
 public:
  using Points = std::vector<Eigen::Vector3d>;
  using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<double>, Points>;

  bool boolean(const std::string& key) const;
  std::int64_t integer(const std::string& key) const;
  double quantity(const std::string& key) const;  // SI
  const std::string& text(const std::string& key) const;
  const std::vector<double>& quantities(const std::string& key) const;  // SI
  const Points& points(const std::string& key) const;                   // SI [m]

  /// Whether the key has a value: given by the user or by a default. Optional keys without a
  /// default have none unless given.
  bool has(const std::string& key) const;
  bool was_given(const std::string& key) const;

  /// Where the user gave the value, for messages about combinations of keys.
  Location location(const std::string& key) const;

  /// Every key with its value in SI as text, for provenance in summary.json and checkpoints.
  std::map<std::string, std::string> as_text() const;

  void assign(const std::string& key, Value value, Location location, bool given);

 private:
  struct Entry {
    Value value;
    Location location;
    bool given = false;
  };
  std::map<std::string, Entry> entries_;
};

}  // namespace hemoscale::coupling
