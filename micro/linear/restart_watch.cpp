#include "micro/linear/restart_watch.hpp"

#include <fmt/format.h>

#include <cmath>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

// A start that does not lower the true residual to this part of the one before achieves nothing.
constexpr double worthwhile = 0.9;  // [-]

}  // namespace

bool RestartWatch::is_done(double true_residual) {
  report.relative_residual = true_residual / limits_.reference;
  if (is_reached(true_residual)) {
    return true;
  }
  if (!std::isfinite(true_residual)) {
    fail("values are not finite", true_residual);
  }
  if (before_ >= 0 && true_residual > worthwhile * before_) {
    fail("stagnation", true_residual);
  }
  before_ = true_residual;
  return false;
}

void RestartWatch::count(double residual) {
  if (!std::isfinite(residual)) {
    fail("values are not finite", residual);
  }
  if (report.iterations >= limits_.maximum_iterations) {
    fail("too many iterations", residual);
  }
  ++report.iterations;
}

double RestartWatch::require_positive(double value, const char* reason, double residual) const {
  if (!(value > 0) || !std::isfinite(value)) {
    fail(reason, residual);
  }
  return value;
}

double RestartWatch::require_nonzero(double value, const char* reason, double residual) const {
  if (value == 0 || !std::isfinite(value)) {
    fail(reason, residual);
  }
  return value;
}

void RestartWatch::fail(const char* reason, double residual) const {
  throw NumericalError(fmt::format(
      "{} ended without a solution: {}; {} of at most {} iterations, relative residual {:.3g} "
      "instead of {:.3g}; look for a singular matrix or a null space that was not described, allow "
      "a larger residual, or choose a direct solver",
      method_, reason, report.iterations, limits_.maximum_iterations, residual / limits_.reference,
      limits_.relative_residual));
}

}  // namespace hemoscale::micro
