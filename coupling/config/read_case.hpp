#pragma once

#include <filesystem>
#include <string>

#include "coupling/config/parameter_tree.hpp"
#include "coupling/config/settings.hpp"

namespace hemoscale::coupling {

/// Parses case.toml into a tree with line and column of every value.
/// @throws CaseError (syntax, with place), EnvironmentError (cannot be read)
ParameterTree read_toml(const std::filesystem::path& file);

/// Checks a tree against the parameter table and fills in defaults. Keys of the named variant
/// ([variant.NAME], same layout as the case) replace those of the case first; an empty name takes
/// the case's own `case.variant` if it is given.
/// @throws CaseError with all faults: unknown key (nearest known one), wrong type, wrong unit,
///         out of range, missing, unknown choice, unknown variant, key that does not apply to the
///         chosen model
Settings interpret(const ParameterTree& tree, const std::string& variant);

}  // namespace hemoscale::coupling
