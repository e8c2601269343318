#pragma once

#include <iosfwd>

#include "coupling/program/command_line.hpp"

namespace hemoscale::micro {
class Communicator;
}

// One file per command. They throw; main() turns exceptions into exit codes.
namespace hemoscale::coupling {

/// Reads and checks a case, and tells what a run of it would do.
/// @throws CaseError with all faults, EnvironmentError
void check(const CheckCommand& command, std::ostream& out);

/// Runs a case on all ranks of the communicator; only the root writes to `out`.
/// @throws the errors of run_case()
void run(const RunCommand& command, micro::Communicator&& communicator, std::ostream& out);

/// Runs a study and draws its chart or its map.
/// @throws CaseError with all faults of the study, EnvironmentError
void chart(const ChartCommand& command, std::ostream& out);

/// Prints the parameter table.
/// @throws CaseError for a key that is not known
void print_reference(const ReferenceCommand& command, std::ostream& out);

/// Tells what is installed and usable here.
/// @returns whether everything that a basic run needs is there
bool examine_machine(std::ostream& out);

}  // namespace hemoscale::coupling
