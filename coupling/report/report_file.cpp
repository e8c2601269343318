#include "coupling/report/report_file.hpp"

#include <system_error>

#include "coupling/error.hpp"
#include "micro/error.hpp"
#include "micro/snapshot/durable_file.hpp"

namespace hemoscale::coupling {

void fail_system(const std::filesystem::path& path, const std::string& action, int error) {
  throw EnvironmentError(path.string() + ": cannot " + action + ": " +
                         std::generic_category().message(error));
}

void make_folder_of(const std::filesystem::path& path) {
  if (!path.has_parent_path()) return;
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error) fail_system(path.parent_path(), "make the folder", error.value());
}

void replace_file(const std::filesystem::path& path, std::string_view content) {
  try {
    micro::write_durably(path, content);
  } catch (const micro::EnvironmentError& error) {
    throw EnvironmentError(error.what());
  }
}

std::string read_file(const std::filesystem::path& path) {
  try {
    return micro::read_whole(path);
  } catch (const micro::EnvironmentError& error) {
    throw EnvironmentError(error.what());
  }
}

}  // namespace hemoscale::coupling
