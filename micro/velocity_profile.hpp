#pragma once

#include <array>
#include <vector>

#include "micro/forcing.hpp"

namespace hemoscale::micro {

/// A tabulated profile as piecewise cubics, each through the four nearest points: exact for
/// parabolas and cubics. Beyond the walls the outermost cubic is continued.
class CubicProfile {
 public:
  /// @throws ParameterError unless there are at least four finite velocities and a positive height
  explicit CubicProfile(const VelocityProfile& table);

  /// Velocity along x at a height [m/s].
  double operator()(double y) const {
    const double position = y * inverse_spacing_;
    const double last = static_cast<double>(pieces_.size() - 1);
    const double clamped = position < 0 ? 0 : (position > last ? last : position);
    const auto i = static_cast<std::size_t>(clamped);
    const double t = position - static_cast<double>(i);
    const std::array<double, 4>& c = pieces_[i];
    return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
  }

  /// Upper bound on |du/dy| between the walls [1/s].
  double largest_shear_rate() const { return largest_shear_rate_; }

 private:
  double inverse_spacing_ = 0;                 // [1/m]
  std::vector<std::array<double, 4>> pieces_;  // [m/s] in powers of the distance over the spacing
  double largest_shear_rate_ = 0;              // [1/s]
};

}  // namespace hemoscale::micro
