#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupling/config/parameter_tree.hpp"
#include "coupling/config/settings.hpp"

namespace hemoscale::coupling {

/// Parses case.toml into a tree with line and column of every value.
/// @throws CaseError (syntax, with place), EnvironmentError (cannot be read)
ParameterTree read_toml(const std::filesystem::path& file);

/// One value as case.toml would hold it: 3, true, "10 um", [1, 2].
/// @param location  given to every part of it
/// @returns nothing if the text is not one TOML value
std::optional<ParameterTree> read_toml_value(const std::string& text, const Location& location);

/// A value that replaces what case and variant say: of `--set KEY=VALUE`, or of a run of a study.
struct Override {
  std::string key;      // dotted, e.g. "micro.membrane.stretch_modulus"
  ParameterTree value;  // its location says where it was set
};

/// Checks a tree against the parameter table and fills in defaults. Keys of the named variant
/// ([variant.NAME], same layout as the case) replace those of the case first; an empty name takes
/// the case's own `case.variant` if it is given. The overrides replace keys of both and count as
/// given.
/// @throws CaseError with all faults: unknown key (nearest known one), wrong type, wrong unit,
///         out of range, missing, unknown choice, unknown variant, key that does not apply to the
///         chosen model
Settings interpret(const ParameterTree& tree, const std::string& variant,
                   const std::vector<Override>& overrides = {});

}  // namespace hemoscale::coupling
