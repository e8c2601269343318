#pragma once

#include <array>
#include <vector>

#include "micro/ensemble/flow/given_flow.hpp"
#include "micro/forcing.hpp"

namespace hemoscale::micro {

/// Steady flow along x that depends on y alone, as the piecewise cubic of CubicProfile: the
/// velocity is the one that the reference ensemble sees, and a parabola is exact up to its second
/// derivative. Beyond the walls the outermost cubic is continued.
class ParallelFlow final : public GivenFlow {
 public:
  /// @throws ParameterError unless there are at least four finite velocities and a positive height
  explicit ParallelFlow(const VelocityProfile& table);

  LocalFlow at(const Vector<2>& x, double time) const override;
  bool is_steady() const override { return true; }
  double largest_shear_rate() const override { return largest_shear_rate_; }
  double largest_speed() const override { return largest_speed_; }

 private:
  double inverse_spacing_ = 0;                 // [1/m]
  std::vector<std::array<double, 4>> pieces_;  // [m/s] in powers of the distance over the spacing
  double largest_shear_rate_ = 0;              // [1/s]
  double largest_speed_ = 0;                   // [m/s]
};

/// u = (shear_rate y, 0).
class SimpleShearFlow final : public GivenFlow {
 public:
  /// @param shear_rate  [1/s] of either sign
  /// @param height      [m] the fluid lies at |y| <= height; bounds the speed and nothing else
  /// @throws ParameterError for a shear rate that is not finite or a height that is not positive
  SimpleShearFlow(double shear_rate, double height);

  LocalFlow at(const Vector<2>& x, double time) const override;
  bool is_steady() const override { return true; }
  double largest_shear_rate() const override;
  double largest_speed() const override;

 private:
  double shear_rate_ = 0;  // [1/s]
  double height_ = 0;      // [m]
};

}  // namespace hemoscale::micro
