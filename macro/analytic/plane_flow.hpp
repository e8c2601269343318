#pragma once

#include <optional>

#include "macro/flow_field.hpp"

namespace hemoscale::macro {

/// A unidirectional flow at one distance from the wall (plane) or the axis (pipe), and one time.
struct ProfilePoint {
  double velocity = 0;           // [m/s] along x
  double gradient = 0;           // [1/s] derivative of the velocity across the flow
  double pressure_gradient = 0;  // [Pa/m] G = -dp/dx
};

/// Flow along x in the channel 0 <= y <= height; in three dimensions z is neutral. The pressure is
/// relative to that at x = 0. Empty outside the channel.
///
/// @tparam Profile  a value with `height` [m], check(profile), and
///                  evaluate(profile, y, t) -> ProfilePoint
template <int dim, typename Profile>
class PlaneFlow final : public FlowField<dim> {
 public:
  /// @throws ParameterError naming the first parameter that is not admissible
  explicit PlaneFlow(const Profile& profile) : profile_(profile) { check(profile_); }

  std::optional<FlowState<dim>> at(const Vector<dim>& x, double t) const override {
    if (!(x[1] >= 0 && x[1] <= profile_.height)) return std::nullopt;
    const ProfilePoint point = evaluate(profile_, x[1], t);
    FlowState<dim> state;
    state.velocity[0] = point.velocity;
    state.velocity_gradient(0, 1) = point.gradient;
    state.pressure = -point.pressure_gradient * x[0];
    return state;
  }

  const Profile& profile() const { return profile_; }

 private:
  Profile profile_;
};

}  // namespace hemoscale::macro
