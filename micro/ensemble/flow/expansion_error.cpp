#include "micro/ensemble/flow/expansion_error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "micro/error.hpp"

namespace hemoscale::micro {

double expansion_error(const GivenFlow& flow, double time, double radius,
                       const std::vector<Vector<2>>& points) {
  if (!(radius > 0) || !std::isfinite(radius) || points.empty()) {
    throw ParameterError(fmt::format(
        "expansion error: radius {} m, {} points; the radius must be positive and there "
        "must be a point; give those of the cells",
        radius, points.size()));
  }
  constexpr int directions = 16;
  double largest = 0;
  for (const Vector<2>& x : points) {
    const LocalFlow expansion = flow.at(x, time);
    for (int k = 0; k < directions; ++k) {
      const double angle = 2 * std::numbers::pi * k / directions;
      for (const double distance : {0.5 * radius, radius}) {
        const Vector<2> d = distance * Vector<2>(std::cos(angle), std::sin(angle));
        const double error = (flow.at(x + d, time).velocity - velocity_at(expansion, d)).norm();
        largest = std::max(largest, error);
      }
    }
  }
  return largest;
}

Vector<2> velocity_at(const LocalFlow& flow, const Vector<2>& d) {
  const Vector<2> curved(d.dot(flow.second[0] * d), d.dot(flow.second[1] * d));
  return flow.velocity + flow.gradient * d + 0.5 * curved;
}

}  // namespace hemoscale::micro
