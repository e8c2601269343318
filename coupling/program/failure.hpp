#pragma once

#include <exception>
#include <string>

namespace hemoscale::coupling {

constexpr int exit_done = 0;
constexpr int exit_usage = 1;        // the command line
constexpr int exit_case = 2;         // CaseError, ParameterError
constexpr int exit_environment = 3;  // EnvironmentError
constexpr int exit_numerics = 4;     // NumericalError
constexpr int exit_defect = 5;       // anything else

/// How a command ended.
struct Outcome {
  int exit_code = exit_done;
  std::string message;  // for standard error, ends with a newline; empty if the command succeeded
};

/// The outcome that an exception stands for. Only main() asks.
Outcome outcome_of(const std::exception_ptr& exception);

}  // namespace hemoscale::coupling
