#include <ostream>

#include "coupling/config/reference.hpp"
#include "coupling/program/commands.hpp"

namespace hemoscale::coupling {

void print_reference(const ReferenceCommand& command, std::ostream& out) {
  out << (command.markdown ? reference_markdown(command.key) : reference_text(command.key));
}

}  // namespace hemoscale::coupling
