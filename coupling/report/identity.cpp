#include "coupling/report/identity.hpp"

#include <algorithm>

#include "micro/snapshot/checksum.hpp"

namespace hemoscale::coupling {

std::map<std::string, std::string> state_settings(
    const std::map<std::string, std::string>& settings, const std::vector<std::string>& free) {
  std::map<std::string, std::string> kept;
  for (const auto& setting : settings) {
    const std::string& key = setting.first;
    const bool is_free = std::any_of(free.begin(), free.end(), [&key](const std::string& name) {
      return key == name || (name.ends_with('.') && key.starts_with(name));
    });
    if (!is_free) kept.insert(setting);
  }
  return kept;
}

std::string identity_hash(const std::map<std::string, std::string>& settings) {
  // Lengths go first, so that no two different lists of settings give the same text.
  std::string text;
  for (const auto& [key, value] : settings) {
    text.append(std::to_string(key.size())).append(":").append(key);
    text.append(std::to_string(value.size())).append(":").append(value);
  }
  return micro::to_hexadecimal(micro::checksum(text));
}

}  // namespace hemoscale::coupling
