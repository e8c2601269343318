#pragma once

#include <string>
#include <vector>

#include "coupling/config/read_case.hpp"
#include "coupling/error.hpp"

namespace hemoscale::coupling {

/// KEY=VALUE of the command line. The value is read as case.toml would hold it where it is TOML
/// (3, true, "text", [1, 2]), else it is text as it stands: 10 um, paper.
/// @throws CaseError with the place "--set KEY" if there is no '=' or no key
Override parse_override(const std::string& text);

/// Several of them.
/// @throws CaseError with the faults of all
std::vector<Override> parse_overrides(const std::vector<std::string>& texts);

/// The inverse: KEY=VALUE such that parse_override() gives the same value back.
std::string override_text(const Override& setting);

/// A value as case.toml would hold it, on one line.
std::string toml_text(const ParameterTree& value);

/// Overrides in the layout of a case. Of two of the same key both are kept: reading them tells.
/// @param faults  those are added that no case could have: a key of a variant, case.variant
ParameterTree override_tree(const std::vector<Override>& overrides, std::vector<Fault>& faults);

}  // namespace hemoscale::coupling
