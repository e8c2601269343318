#include "micro/cells/outline.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "micro/cells/rest_shape.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

/// Point of an outline given by a formula at parameter angle t: x = R cos t. Both are smooth in t.
Vector<2> point(const OutlineParameters& p, double t) {
  const double radius = 0.5 * p.length;
  const double c = std::cos(t);
  if (p.outline == Outline::ellipse) {
    return {radius * c, p.aspect * radius * std::sin(t)};
  }
  const double s = c * c;
  // sqrt(1 - r^2/R^2) = |sin t|; the sign chooses the half.
  return {radius * c, 0.5 * radius * std::sin(t) * (0.207161 + 2.002558 * s - 1.122762 * s * s)};
}

Vector<2> derivative(const OutlineParameters& p, double t) {
  const double radius = 0.5 * p.length;
  const double c = std::cos(t);
  const double d = std::sin(t);
  if (p.outline == Outline::ellipse) {
    return {-radius * d, p.aspect * radius * c};
  }
  const double s = c * c;
  const double thickness = 0.207161 + 2.002558 * s - 1.122762 * s * s;
  const double slope = (2.002558 - 2 * 1.122762 * s) * (-2 * c * d);
  return {-radius * d, 0.5 * radius * (c * thickness + d * slope)};
}

/// Arc length between two parameters that are close together: five-point Gauss rule.
double arc(const OutlineParameters& p, double from, double to) {
  constexpr std::array<double, 3> abscissa = {0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 3> weight = {0.5688888888888889, 0.4786286704993665,
                                            0.2369268850561891};
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  double sum = weight[0] * derivative(p, middle).norm();
  for (std::size_t i = 1; i < 3; ++i) {
    sum += weight[i] * (derivative(p, middle - half * abscissa[i]).norm() +
                        derivative(p, middle + half * abscissa[i]).norm());
  }
  return half * sum;
}

void require_admissible(const OutlineParameters& p, int nodes) {
  if (nodes < 8) {
    throw ParameterError(
        fmt::format("{} nodes per cell; at least 8 are needed to show its shape; use more", nodes));
  }
  if (!(p.length > 0) || !std::isfinite(p.length)) {
    throw ParameterError(fmt::format(
        "length of the outline {} m; it must be finite and positive; a red cell has 7.82e-6",
        p.length));
  }
  if (p.outline == Outline::ellipse && !(p.aspect > 0 && p.aspect <= 1)) {
    throw ParameterError(fmt::format(
        "thickness of the ellipse over its length {}; it must lie in (0, 1]; exchange the axes",
        p.aspect));
  }
}

/// The deflated ring of any size, stretched to the given length.
std::vector<Vector<2>> deflated_nodes(const OutlineParameters& p, int nodes) {
  std::vector<Vector<2>> ring =
      deflate({.perimeter = p.length, .reduced_area = p.reduced_area}, nodes).nodes;
  const auto [left, right] =
      std::minmax_element(ring.begin(), ring.end(),
                          [](const Vector<2>& a, const Vector<2>& b) { return a.x() < b.x(); });
  const double scale = p.length / (right->x() - left->x());
  for (Vector<2>& node : ring) node *= scale;
  return ring;
}

}  // namespace

std::vector<Vector<2>> outline_nodes(const OutlineParameters& parameters, int nodes) {
  require_admissible(parameters, nodes);
  if (parameters.outline == Outline::deflated) return deflated_nodes(parameters, nodes);
  constexpr int intervals = 4096;
  constexpr double width = 2 * std::numbers::pi / intervals;
  std::vector<double> length(intervals + 1, 0.0);
  for (std::size_t i = 0; i < intervals; ++i) {
    const double from = static_cast<double>(i) * width;
    length[i + 1] = length[i] + arc(parameters, from, from + width);
  }
  std::vector<Vector<2>> result;
  result.reserve(static_cast<std::size_t>(nodes));
  std::size_t interval = 0;
  for (int k = 0; k < nodes; ++k) {
    const double wanted = length.back() * k / nodes;
    while (length[interval + 1] <= wanted) {
      ++interval;
    }
    const double start = static_cast<double>(interval) * width;
    double t =
        start + width * (wanted - length[interval]) / (length[interval + 1] - length[interval]);
    // Newton's method; the interpolated start is good to four digits, so that three steps reach
    // round-off.
    for (int iteration = 0; iteration < 3; ++iteration) {
      t -= (length[interval] + arc(parameters, start, t) - wanted) /
           derivative(parameters, t).norm();
    }
    result.push_back(point(parameters, t));
  }
  return result;
}

}  // namespace hemoscale::micro
