#pragma once

#include <stdexcept>
#include <string>

namespace hemoscale::micro {

/// The numerics of the micro scale failed: a limit exceeded, a value not finite. The message holds
/// step, time, cell or particle, value, limit and remedy.
struct NumericalError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file (HDF5) or MPI failed; the message holds the path or the rank and the system's reason.
struct EnvironmentError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A parameter of a micro model is outside its admissible range.
struct ParameterError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace hemoscale::micro
