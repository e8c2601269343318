#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/config/parameter_table.hpp"
#include "coupling/config/parameter_tree.hpp"
#include "coupling/config/settings.hpp"
#include "coupling/config/units.hpp"
#include "coupling/error.hpp"

namespace hemoscale::coupling {

/// Turns what the user wrote into a checked value in SI.
///
/// Text stands for a value of any kind where an OpenFOAM dictionary would hold a word: "0.4" is a
/// number, "yes", "no", "on" and "off" are booleans besides "true" and "false". A number without a
/// unit is in SI.
class ValueReader {
 public:
  /// @param faults  where faults are added; outlives the reader
  /// @throws EnvironmentError if the database of units cannot be read
  explicit ValueReader(std::vector<Fault>& faults) : faults_(faults) {}

  /// @param key  as the user wrote it, for messages, e.g. "variant.fine.micro.nodes"
  /// @returns    the value, or nothing after adding at least one fault
  std::optional<Settings::Value> read(const Parameter& parameter, const std::string& key,
                                      const ParameterTree& node);

 private:
  std::optional<double> read_real(const Parameter& parameter, const std::string& key,
                                  const ParameterTree& node);
  std::optional<double> read_real_text(const Parameter& parameter, const std::string& key,
                                       const ParameterTree& node, const std::string& text);
  std::optional<std::int64_t> read_integer(const Parameter& parameter, const std::string& key,
                                           const ParameterTree& node);
  std::optional<bool> read_boolean(const Parameter& parameter, const std::string& key,
                                   const ParameterTree& node);
  std::optional<std::string> read_text(const Parameter& parameter, const std::string& key,
                                       const ParameterTree& node);
  std::optional<std::vector<double>> read_list(const Parameter& parameter, const std::string& key,
                                               const ParameterTree& node);
  std::optional<Settings::Points> read_points(const Parameter& parameter, const std::string& key,
                                              const ParameterTree& node);

  bool is_list_of_length(const Parameter& parameter, const std::string& key,
                         const ParameterTree& node);
  void add(const std::string& key, const Location& location, const std::string& message);
  void add_wrong_type(const Parameter& parameter, const std::string& key,
                      const ParameterTree& node);
  bool in_range(const Parameter& parameter, const std::string& key, const ParameterTree& node,
                double value);

  UnitSystem units_;
  std::vector<Fault>& faults_;
};

/// What the user wrote, for messages: quoted, without control characters, at most 60 bytes of it.
std::string shown(const ParameterTree& node);
std::string shown(const std::string& text);

}  // namespace hemoscale::coupling
