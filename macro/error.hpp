#pragma once

#include <stdexcept>
#include <string>

namespace hemoscale::macro {

/// The numerics of the macro scale failed: no convergence, not finite, a limit exceeded.
struct NumericalError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file, a library or a program that the macro scale needs is missing or unusable.
struct EnvironmentError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A parameter of a flow or a viscosity law is outside its admissible range.
struct ParameterError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace hemoscale::macro
