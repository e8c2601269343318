#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace hemoscale::coupling {

/// Draws by the Python script; what it prints, the path of the picture, goes to `out`.
/// @param arguments  of the script
/// @throws EnvironmentError with the reason: no Python, no matplotlib
void draw(const std::filesystem::path& script, const std::vector<std::string>& arguments,
          std::ostream& out);

}  // namespace hemoscale::coupling
