#pragma once

#include <filesystem>
#include <string>
#include <string_view>

// For the sources of report and study: files with this layer's EnvironmentError.
namespace hemoscale::coupling {

/// Throws EnvironmentError "<path>: cannot <action>: <text of the system's error number>".
[[noreturn]] void fail_system(const std::filesystem::path& path, const std::string& action,
                              int error);

void make_folder_of(const std::filesystem::path& path);

/// Written aside, then renamed.
void replace_file(const std::filesystem::path& path, std::string_view content);
std::string read_file(const std::filesystem::path& path);

}  // namespace hemoscale::coupling
