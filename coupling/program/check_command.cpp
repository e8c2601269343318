#include <ostream>

#include "coupling/config/overrides.hpp"
#include "coupling/program/commands.hpp"
#include "coupling/scene/run_case.hpp"

namespace hemoscale::coupling {

void check(const CheckCommand& command, std::ostream& out) {
  const Settings settings =
      load_case(command.case_folder, command.variant, false, parse_overrides(command.set));
  out << describe_case(settings) << "no faults\n";
}

}  // namespace hemoscale::coupling
