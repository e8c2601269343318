#include "macro/analytic/gauss_legendre.hpp"

#include <cmath>
#include <cstddef>

#include "macro/analytic/bracketed_root.hpp"

namespace hemoscale::macro {

namespace {

// P_n and P_n' by the three-term recurrence.
ValueAndSlope legendre(int n, double x) {
  double before = 1;
  double now = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
    before = now;
    now = next;
  }
  return {now, n * (x * now - before) / (x * x - 1)};
}

}  // namespace

GaussLegendre gauss_legendre() {
  constexpr int n = GaussLegendre::points;
  const double pi = std::acos(-1.0);
  GaussLegendre rule;
  for (int i = 0; i < n; ++i) {
    // Tricomi's estimate is close enough for Newton's method to converge in a few steps.
    double x = -std::cos(pi * (i + 0.75) / (n + 0.5));
    for (int step = 0; step < 8; ++step) {
      const ValueAndSlope p = legendre(n, x);
      x -= p.value / p.slope;
    }
    const double slope = legendre(n, x).slope;
    rule.nodes[static_cast<std::size_t>(i)] = x;
    rule.weights[static_cast<std::size_t>(i)] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace hemoscale::macro
