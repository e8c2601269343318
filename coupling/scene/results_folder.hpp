#pragma once

#include <filesystem>
#include <string>

namespace hemoscale::coupling {

/// Makes the folder of a run ready. Without restart an existing folder that holds results is moved
/// aside to NAME.1, NAME.2, ... (the first number that is free), so that nothing already written is
/// ever lost. One process calls it.
///
/// @returns a line that tells what was moved; empty if nothing was
/// @throws EnvironmentError with path and the system's reason; also if a restart finds no folder
std::string prepare_results_folder(const std::filesystem::path& folder, bool restart);

}  // namespace hemoscale::coupling
