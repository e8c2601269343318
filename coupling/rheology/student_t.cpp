#include "coupling/rheology/student_t.hpp"

#include <unsupported/Eigen/SpecialFunctions>

#include <cassert>
#include <cmath>
#include <limits>

namespace hemoscale::coupling {

namespace {

// P(|T| > t)
double two_sided_tail(double t, double nu) {
  if (nu > 1e7) return std::erfc(t / std::sqrt(2.0));  // relative difference below 1e-6
  return Eigen::numext::betainc(0.5 * nu, 0.5, nu / (nu + t * t));
}

}  // namespace

double student_t_half_width(double probability, double degrees_of_freedom) {
  assert(probability > 0 && probability < 1);
  if (!(degrees_of_freedom > 0)) return std::numeric_limits<double>::infinity();
  const double tail = 1 - probability;
  double low = 0;
  double high = 1;
  while (two_sided_tail(high, degrees_of_freedom) > tail) {
    low = high;
    high *= 2;
    if (high > 1e150) return std::numeric_limits<double>::infinity();  // t^2 must stay finite
  }
  // Bisection to the last bit: the tail falls with t, and this is called once for each knot.
  for (double t = 0.5 * (low + high); t > low && t < high; t = 0.5 * (low + high)) {
    (two_sided_tail(t, degrees_of_freedom) > tail ? low : high) = t;
  }
  return high;
}

double sidak_probability(double probability, int count) {
  assert(count >= 1);
  return std::pow(probability, 1.0 / count);
}

}  // namespace hemoscale::coupling
