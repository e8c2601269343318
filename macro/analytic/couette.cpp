#include "macro/analytic/couette.hpp"

#include "macro/parameter_check.hpp"

namespace hemoscale::macro {

void check(const PlaneCouetteProfile& profile) {
  const char* owner = "plane Couette flow";
  require_positive({owner, "height", profile.height, "m"}, "give the distance between the walls");
  require_finite({owner, "wall_velocity", profile.wall_velocity, "m/s"},
                 "give the velocity of the wall y = height");
}

ProfilePoint evaluate(const PlaneCouetteProfile& profile, double y, double /*t*/) {
  // y / height is exactly 1 at the wall, so that the fluid there has exactly the wall's velocity.
  return {profile.wall_velocity * (y / profile.height), profile.wall_velocity / profile.height, 0};
}

template <int dim>
SimpleShear<dim>::SimpleShear(double shear_rate) : shear_rate_(shear_rate) {
  require_finite({"simple shear", "shear_rate", shear_rate, "1/s"}, "give du/dy");
}

template <int dim>
std::optional<FlowState<dim>> SimpleShear<dim>::at(const Vector<dim>& x, double /*t*/) const {
  FlowState<dim> state;
  state.velocity[0] = shear_rate_ * x[1];
  state.velocity_gradient(0, 1) = shear_rate_;
  return state;
}

template class SimpleShear<2>;
template class SimpleShear<3>;

}  // namespace hemoscale::macro
