#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/unit/results/python_script.hpp"

namespace hemoscale::tests {

/// Exit status of plot.py for a folder of results.
inline int plot(const std::filesystem::path& results) {
  return run_script("coupling/report/plot.py", results);
}

/// Whether a file is a PNG of more than an empty frame.
inline bool is_picture(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string signature(4, '\0');
  file.read(signature.data(), 4);
  return signature == "\x89PNG" && std::filesystem::file_size(path) > 5000;
}

}  // namespace hemoscale::tests
