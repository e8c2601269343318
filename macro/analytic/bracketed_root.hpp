#pragma once

#include <cmath>
#include <limits>

namespace hemoscale::macro {

/// Value and derivative of a function at one point.
struct ValueAndSlope {
  double value = 0;
  double slope = 0;
};

/// Root of an increasing function that is negative at `low` and not negative at `high` (neither end
/// is evaluated): Newton's method that bisects whenever a step would leave the bracket, or is not
/// smaller than half the step before the last (Dekker 1969 and Brent 1973 use the same safeguards).
///
/// Depends on its arguments alone, so that equal brackets give equal bits. Ends when |value| is at
/// most `tolerance`, or when rounding stops further progress; the best point seen is returned.
template <typename Function>
double bracketed_root(const Function& function, double low, double high, double tolerance) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  double best = high;
  double smallest = std::numeric_limits<double>::infinity();
  double step = high - low;
  double step_before = step;
  double x = low + 0.5 * (high - low);
  while (x > low && x < high) {
    const ValueAndSlope f = function(x);
    if (std::abs(f.value) < smallest) {
      smallest = std::abs(f.value);
      best = x;
    }
    if (std::abs(f.value) <= tolerance) return x;
    (f.value < 0 ? low : high) = x;
    const double newton = x - f.value / f.slope;
    const bool trusted =
        newton > low && newton < high && std::abs(2 * f.value) <= std::abs(step_before * f.slope);
    const double next = trusted ? newton : low + 0.5 * (high - low);
    step_before = step;
    step = next - x;
    if (std::abs(step) <= 2 * epsilon * std::abs(x)) return best;
    x = next;
  }
  return best;
}

}  // namespace hemoscale::macro
