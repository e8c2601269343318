#include <unistd.h>

#include <array>
#include <climits>
#include <filesystem>
#include <ostream>
#include <string>

#include "coupling/error.hpp"
#include "coupling/program/commands.hpp"
#include "coupling/study/chart_study.hpp"
#include "coupling/study/read_study.hpp"

namespace hemoscale::coupling {

namespace {

std::filesystem::path this_program() {
  std::array<char, PATH_MAX> path{};
  const ssize_t length = readlink("/proc/self/exe", path.data(), path.size() - 1);
  if (length <= 0) throw EnvironmentError("/proc/self/exe cannot be read; is /proc mounted?");
  return std::string(path.data(), static_cast<std::size_t>(length));
}

}  // namespace

void chart(const ChartCommand& command, std::ostream& out) {
  const Study study = read_study(command.study);
  StudyOptions options;
  options.runner = {this_program(), command.jobs, command.fresh};
  // Scripts lie beside the program, in the build tree as after installation.
  options.script = options.runner.program.parent_path() / ".." / HEMOSCALE_SCRIPTS / "chart.py";
  options.list = command.list;
  (command.map ? map_study : chart_study)(study, options, out);
}

}  // namespace hemoscale::coupling
