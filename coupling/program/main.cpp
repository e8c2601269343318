#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <variant>

#include "coupling/error.hpp"
#include "coupling/program/command_line.hpp"
#include "coupling/program/commands.hpp"
#include "coupling/program/failure.hpp"
#include "coupling/program/mpi_session.hpp"

namespace {

using namespace hemoscale::coupling;

/// Executes a command; its exit code is the result, exceptions are failures.
struct Execute {
  MpiSession* mpi;  // null if the process runs alone

  int operator()(const Answered& answered) const { return answered.exit_code; }
  int operator()(const CheckCommand& command) const {
    check(command, std::cout);
    return exit_done;
  }
  int operator()(const RunCommand& command) const {
    run(command, mpi != nullptr ? mpi->communicator() : hemoscale::micro::Communicator(),
        std::cout);
    return exit_done;
  }
  int operator()(const ChartCommand& command) const {
    chart(command, std::cout);
    return exit_done;
  }
  int operator()(const ReferenceCommand& command) const {
    print_reference(command, std::cout);
    return exit_done;
  }
  int operator()(const DoctorCommand&) const {
    return examine_machine(std::cout) ? exit_done : exit_environment;
  }
};

/// The only place where exceptions become exit codes.
Outcome attempt(const Command& command, MpiSession* mpi) {
  try {
    const int exit_code = std::visit(Execute{mpi}, command);
    if (!std::cout.flush()) {
      throw EnvironmentError("standard output cannot be written; is the disk full?");
    }
    return {exit_code, ""};
  } catch (...) {
    return outcome_of(std::current_exception());
  }
}

}  // namespace

int main(int count, char** arguments) {
  try {
    const Command command = parse_command_line(count, arguments);
    std::unique_ptr<MpiSession> mpi;
    if (std::holds_alternative<RunCommand>(command) && is_launched_by_mpi()) {
      mpi = std::make_unique<MpiSession>(&count, &arguments);
    }
    Outcome outcome = attempt(command, mpi.get());
    if (mpi) outcome = mpi->end_together(outcome);
    std::fputs(outcome.message.c_str(), stderr);
    return outcome.exit_code;
  } catch (...) {
    const Outcome outcome = outcome_of(std::current_exception());
    std::fputs(outcome.message.c_str(), stderr);
    return outcome.exit_code;
  }
}
