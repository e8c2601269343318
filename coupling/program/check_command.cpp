#include <ostream>

#include "coupling/program/commands.hpp"
#include "coupling/scene/run_case.hpp"

namespace hemoscale::coupling {

void check(const CheckCommand& command, std::ostream& out) {
  const Settings settings = load_case(command.case_folder, command.variant);
  out << describe_case(settings) << "no faults\n";
}

}  // namespace hemoscale::coupling
