#pragma once

#include <map>
#include <string>
#include <vector>

namespace hemoscale::coupling {

/// The settings that define the state of a run: all but those that may change between a run and its
/// continuation (how long, how precise, how much is written, on how many processors).
///
/// @param settings  every key with its value, as text
/// @param free      keys that may change; a name that ends in "." stands for all keys below it
std::map<std::string, std::string> state_settings(
    const std::map<std::string, std::string>& settings, const std::vector<std::string>& free);

/// Sixteen hexadecimal digits that stand for these settings; equal settings give equal digits on
/// every machine. For file names and for a glance: checkpoints compare the settings themselves.
std::string identity_hash(const std::map<std::string, std::string>& settings);

}  // namespace hemoscale::coupling
