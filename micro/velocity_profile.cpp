#include "micro/velocity_profile.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "micro/error.hpp"

namespace hemoscale::micro {

CubicProfile::CubicProfile(const VelocityProfile& table) {
  const std::size_t n = table.velocities.size();
  if (n < 4) {
    throw ParameterError(fmt::format(
        "velocity profile of {} points; a cubic needs at least 4; sample the flow more finely", n));
  }
  if (!(table.height > 0) || !std::isfinite(table.height)) {
    throw ParameterError(
        fmt::format("velocity profile: height {} m; it must be finite and positive; "
                    "give the distance between the walls",
                    table.height));
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(table.velocities[i])) {
      throw ParameterError(
          fmt::format("velocity profile: point {} is {} m/s; it must be finite; check "
                      "the flow that it was taken from",
                      i, table.velocities[i]));
    }
  }
  inverse_spacing_ = static_cast<double>(n - 1) / table.height;
  pieces_.resize(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const std::size_t start = std::min(i == 0 ? 0 : i - 1, n - 4);
    const double a = table.velocities[start];
    const double b = table.velocities[start + 1];
    const double c = table.velocities[start + 2];
    const double d = table.velocities[start + 3];
    // Newton's form in u = distance from `start`, then shifted to the beginning of this piece.
    const double d1 = b - a;
    const double d2 = 0.5 * (c - 2 * b + a);
    const double d3 = (d - 3 * c + 3 * b - a) / 6;
    const double p1 = d1 - d2 + 2 * d3;
    const double p2 = d2 - 3 * d3;
    const double p3 = d3;
    const double u = static_cast<double>(i - start);
    pieces_[i] = {a + u * (p1 + u * (p2 + u * p3)), p1 + u * (2 * p2 + u * 3 * p3), p2 + 3 * u * p3,
                  p3};
    const std::array<double, 4>& q = pieces_[i];
    const double slope = std::abs(q[1]) + 2 * std::abs(q[2]) + 3 * std::abs(q[3]);
    largest_shear_rate_ = std::max(largest_shear_rate_, slope * inverse_spacing_);
  }
}

}  // namespace hemoscale::micro
