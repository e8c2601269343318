#pragma once

#include "micro/linear/linear_solver.hpp"

namespace hemoscale::micro {

/// What an iteration starts from and when it ends.
struct KrylovLimits {
  double reference = 1;              // norm that residuals are compared with, usually |b|
  double relative_residual = 1e-10;  // [-]
  int maximum_iterations = 2000;     // [-]
};

/// Watches an iteration that starts anew, from the residual b - A x, whenever its recursion ends:
/// counts, decides, and throws the NumericalError of every way to fail.
class RestartWatch {
 public:
  RestartWatch(const char* method, const KrylovLimits& limits) : method_(method), limits_(limits) {}

  SolveReport report;

  /// At a start: is the true residual small enough?
  /// @throws NumericalError if it is not finite, or hardly less than at the start before
  bool is_done(double true_residual);

  /// Is the residual of the recursion small enough?
  bool is_reached(double residual) const {
    return residual <= limits_.relative_residual * limits_.reference;
  }

  /// Begins one iteration.
  /// @throws NumericalError if there were too many, or the residual is not finite
  void count(double residual);

  /// Returns the value.
  /// @throws NumericalError naming the reason if it is not positive
  double require_positive(double value, const char* reason, double residual) const;

  /// Returns the value.
  /// @throws NumericalError naming the reason if it is zero or not finite
  double require_nonzero(double value, const char* reason, double residual) const;

 private:
  [[noreturn]] void fail(const char* reason, double residual) const;

  const char* method_;
  KrylovLimits limits_;
  double before_ = -1;  // true residual at the start before
};

}  // namespace hemoscale::micro
