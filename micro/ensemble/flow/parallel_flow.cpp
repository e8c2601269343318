#include "micro/ensemble/flow/parallel_flow.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "micro/error.hpp"
#include "micro/velocity_profile.hpp"

namespace hemoscale::micro {
namespace {

/// The cubic through the values at t = 1/8, 3/8, 5/8, 7/8, in powers of t. The points lie well
/// inside their interval, so that all four values come from the same cubic of a profile.
std::array<double, 4> cubic_through(const std::array<double, 4>& v) {
  const double d1 = v[1] - v[0];
  const double d2 = 0.5 * (v[2] - 2 * v[1] + v[0]);
  const double d3 = (v[3] - 3 * v[2] + 3 * v[1] - v[0]) / 6;
  // Newton's form in s = 4 t - 1/2, whose nodes are 0, 1, 2, 3; then in powers of s, then of t.
  const double s1 = d1 - d2 + 2 * d3;
  const double s2 = d2 - 3 * d3;
  return {v[0] - 0.5 * s1 + 0.25 * s2 - 0.125 * d3, 4 * (s1 - s2 + 0.75 * d3), 16 * (s2 - 1.5 * d3),
          64 * d3};
}

}  // namespace

ParallelFlow::ParallelFlow(const VelocityProfile& table) {
  const CubicProfile profile(table);
  const std::size_t intervals = table.velocities.size() - 1;
  const double spacing = table.height / static_cast<double>(intervals);
  inverse_spacing_ = static_cast<double>(intervals) / table.height;
  largest_shear_rate_ = profile.largest_shear_rate();
  for (std::size_t i = 0; i < intervals; ++i) {
    std::array<double, 4> values{};
    for (std::size_t k = 0; k < 4; ++k) {
      const double t = 0.25 * static_cast<double>(k) + 0.125;
      values[k] = profile(spacing * (static_cast<double>(i) + t));
    }
    const std::array<double, 4> c = cubic_through(values);
    pieces_.push_back(c);
    // Bernstein's coefficients enclose a cubic.
    for (const double bound :
         {c[0], c[0] + c[1] / 3, c[0] + (2 * c[1] + c[2]) / 3, c[0] + c[1] + c[2] + c[3]}) {
      largest_speed_ = std::max(largest_speed_, std::abs(bound));
    }
  }
}

LocalFlow ParallelFlow::at(const Vector<2>& x, double /*time*/) const {
  const double position = x[1] * inverse_spacing_;
  const double last = static_cast<double>(pieces_.size() - 1);
  // Of the pieces the outermost ones are continued beyond the walls.
  const double piece = std::floor(std::clamp(position, 0.0, last));
  const std::array<double, 4>& c = pieces_[static_cast<std::size_t>(piece)];
  const double t = position - piece;
  LocalFlow flow;
  flow.velocity[0] = c[0] + t * (c[1] + t * (c[2] + t * c[3]));
  flow.gradient(0, 1) = (c[1] + t * (2 * c[2] + t * 3 * c[3])) * inverse_spacing_;
  flow.second[0](1, 1) = (2 * c[2] + t * 6 * c[3]) * inverse_spacing_ * inverse_spacing_;
  return flow;
}

SimpleShearFlow::SimpleShearFlow(double shear_rate, double height)
    : shear_rate_(shear_rate), height_(height) {
  if (!std::isfinite(shear_rate)) {
    throw ParameterError(fmt::format(
        "simple shear: shear rate {} 1/s; it must be finite; give another one", shear_rate));
  }
  if (!(height > 0) || !std::isfinite(height)) {
    throw ParameterError(fmt::format(
        "simple shear: height {} m; it must be finite and positive; give that of the box", height));
  }
}

LocalFlow SimpleShearFlow::at(const Vector<2>& x, double /*time*/) const {
  LocalFlow flow;
  flow.velocity[0] = shear_rate_ * x[1];
  flow.gradient(0, 1) = shear_rate_;
  return flow;
}

double SimpleShearFlow::largest_shear_rate() const {
  return std::abs(shear_rate_);
}

double SimpleShearFlow::largest_speed() const {
  return std::abs(shear_rate_) * height_;
}

}  // namespace hemoscale::micro
