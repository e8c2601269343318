#pragma once

#include <filesystem>

#include "coupling/study/study.hpp"

namespace hemoscale::coupling {

/// Reads a study file. Keys of cases are not looked at here: planning the runs does.
/// @param named  a study file, or a folder that holds study.toml
/// @throws CaseError with all faults: syntax, unknown key (nearest known one), wrong type, missing;
///         EnvironmentError (cannot be read)
Study read_study(const std::filesystem::path& named);

}  // namespace hemoscale::coupling
