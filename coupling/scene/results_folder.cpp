#include "coupling/scene/results_folder.hpp"

#include <fmt/format.h>

#include "coupling/error.hpp"

namespace hemoscale::coupling {

namespace fs = std::filesystem;

namespace {

bool holds_results(const fs::path& folder) {
  if (!fs::is_directory(folder)) return fs::exists(folder);
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    for (const char* kind : {"series", "summary", "checkpoint", "trajectory"}) {
      if (name.rfind(kind, 0) == 0) return true;
    }
  }
  return false;
}

}  // namespace

std::string prepare_results_folder(const fs::path& folder, bool restart) {
  try {
    if (restart) {
      if (fs::is_directory(folder)) return {};
      throw EnvironmentError(
          fmt::format("{}: no such folder, so there is no checkpoint to restart from; run without "
                      "--restart, or "
                      "name the folder of the earlier run with --results",
                      folder.string()));
    }
    std::string told;
    if (holds_results(folder)) {
      fs::path aside;
      for (int number = 1; fs::exists(aside) || aside.empty(); ++number) {
        aside = folder;
        aside += fmt::format(".{}", number);
      }
      fs::rename(folder, aside);
      told = fmt::format("earlier results moved to {}", aside.string());
    }
    fs::create_directories(folder);
    return told;
  } catch (const fs::filesystem_error& error) {
    throw EnvironmentError(
        fmt::format("{}: cannot be used for results: {}; choose another folder "
                    "with --results",
                    folder.string(), error.code().message()));
  }
}

}  // namespace hemoscale::coupling
