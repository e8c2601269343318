#pragma once

#include <cmath>
#include <optional>

#include "macro/analytic/plane_flow.hpp"

namespace hemoscale::macro {

/// Flow along x in the pipe y^2 + z^2 <= radius^2. The pressure is relative to that at x = 0. Empty
/// outside the pipe.
///
/// @tparam Profile  a value with `radius` [m], check(profile), and
///                  evaluate(profile, r, t) -> ProfilePoint
template <typename Profile>
class PipeFlow final : public FlowField<3> {
 public:
  /// @throws ParameterError naming the first parameter that is not admissible
  explicit PipeFlow(const Profile& profile) : profile_(profile) { check(profile_); }

  std::optional<FlowState<3>> at(const Vector<3>& x, double t) const override {
    const double r = std::hypot(x[1], x[2]);
    if (!(r <= profile_.radius)) return std::nullopt;
    const ProfilePoint point = evaluate(profile_, r, t);
    FlowState<3> state;
    state.velocity[0] = point.velocity;
    if (r > 0) {  // on the axis the gradient is zero by symmetry
      state.velocity_gradient(0, 1) = point.gradient * x[1] / r;
      state.velocity_gradient(0, 2) = point.gradient * x[2] / r;
    }
    state.pressure = -point.pressure_gradient * x[0];
    return state;
  }

  const Profile& profile() const { return profile_; }

 private:
  Profile profile_;
};

}  // namespace hemoscale::macro
