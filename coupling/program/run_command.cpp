#include <ostream>
#include <utility>

#include "coupling/config/overrides.hpp"
#include "coupling/program/commands.hpp"
#include "coupling/scene/run_case.hpp"
#include "micro/parallel/communicator.hpp"

namespace hemoscale::coupling {

void run(const RunCommand& command, micro::Communicator&& communicator, std::ostream& out) {
  const RunOptions options = {command.case_folder, command.variant, command.results,
                              command.restart,     command.force,   parse_overrides(command.set)};
  run_case(options, std::move(communicator), out);
}

}  // namespace hemoscale::coupling
