#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace hemoscale::tests {

/// Debian's Python, which has Debian's modules.
inline const std::string python = "/usr/bin/python3";

/// Exit status of a script of the source tree, called with one argument; its output is dropped.
inline int run_script(const std::string& script, const std::filesystem::path& argument) {
  const std::string command = python + " '" + HEMOSCALE_SOURCE_DIR + "/" + script + "' '" +
                              argument.string() + "' > /dev/null";
  return std::system(command.c_str());  // NOLINT(concurrency-mt-unsafe)
}

inline bool has_module(const std::string& name) {
  // NOLINTNEXTLINE(concurrency-mt-unsafe)
  return std::system((python + " -c 'import " + name + "' 2> /dev/null").c_str()) == 0;
}

}  // namespace hemoscale::tests
