#include "coupling/study/picture.hpp"

#include <fmt/format.h>

#include <ostream>

#include "coupling/error.hpp"
#include "coupling/scene/child_process.hpp"

namespace hemoscale::coupling {

namespace fs = std::filesystem;

void draw(const fs::path& script, const std::vector<std::string>& arguments, std::ostream& out) {
  // Debian's Python, for which Debian packages matplotlib; another one only in its absence.
  std::error_code ignored;
  const char* python = fs::exists("/usr/bin/python3", ignored) ? "/usr/bin/python3" : "python3";
  std::vector<std::string> command = {python, "-B", script.string()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  std::string last_line;
  int status = -1;
  try {
    status = run_child({command, ".", "/dev/null", {}}, [&last_line](const std::string& line) {
      if (!line.empty()) last_line = line;
    });
  } catch (const EnvironmentError& error) {
    last_line = error.what();
  }
  if (status != 0) {
    throw EnvironmentError(fmt::format(
        "the tables are written, but there is no picture: {}; `hemoscale doctor` tells what is "
        "installed; then start the study again: finished runs are kept",
        last_line));
  }
  out << last_line << "\n";
}

}  // namespace hemoscale::coupling
