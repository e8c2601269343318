#pragma once

#include <array>

namespace hemoscale::macro {

/// Gauss-Legendre rule on [-1, 1]: exact for polynomials up to degree 2 `points` - 1.
struct GaussLegendre {
  static constexpr int points = 16;
  std::array<double, points> nodes{};
  std::array<double, points> weights{};
};

/// Nodes as roots of the Legendre polynomial by Newton's method, weights 2 / ((1 - x^2) P'(x)^2)
/// (Abramowitz and Stegun 1964, 25.4.29). Good to rounding.
GaussLegendre gauss_legendre();

/// Integral of `function` over [low, high] by one application of the rule.
template <typename Function>
double integrate(const GaussLegendre& rule, const Function& function, double low, double high) {
  const double middle = 0.5 * (low + high);
  const double half = 0.5 * (high - low);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    sum += rule.weights[i] * function(middle + half * rule.nodes[i]);
  }
  return half * sum;
}

}  // namespace hemoscale::macro
