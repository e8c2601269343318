#include "micro/mps/limits.hpp"

#include <fmt/format.h>

#include <limits>

#include "micro/error.hpp"
#include "micro/mps/reference_density.hpp"

namespace hemoscale::micro {

std::string describe(const Limit& limit) {
  return fmt::format("{}: {:.4g} {} {} {:.4g} {}; {}", limit.name, limit.value, limit.unit,
                     limit.exceeded() ? "exceeds" : "is within", limit.limit, limit.unit,
                     limit.remedy);
}

void require_within(const std::vector<Limit>& limits, bool force) {
  if (force) return;
  std::string faults;
  for (const Limit& limit : limits) {
    if (limit.exceeded()) faults += (faults.empty() ? "" : "\n") + describe(limit);
  }
  if (!faults.empty()) throw ParameterError(faults + "; or force the run");
}

template <int dim>
Limit viscous_limit(double time_step, double kinematic_viscosity, double spacing, double radius) {
  const double largest = kinematic_viscosity * largest_laplacian_eigenvalue<dim>(radius);
  const double limit =
      largest > 0 ? 2 * spacing * spacing / largest : std::numeric_limits<double>::infinity();
  return {
      .name = "viscous limit",
      .value = time_step,
      .limit = limit,
      .unit = "s",
      .remedy = fmt::format("reduce the time step below 2 l0^2/(nu Lambda) (Laplacian radius {:g} "
                            "spacings), or choose implicit viscosity",
                            radius)};
}

Limit advective_limit(double time_step, double speed, double spacing) {
  return {.name = "advective limit",
          .value = time_step,
          .limit = 0.5 * spacing / speed,
          .unit = "s",
          .remedy = "reduce the time step below l0/(2 U)"};
}

Limit splitting_limit(double time_step, double kinematic_viscosity, double gap) {
  return {.name = "splitting error",
          .value = 0.89 * 12 * kinematic_viscosity * time_step / (gap * gap),
          .limit = 0.01,
          .unit = "of the mean velocity",
          .remedy = "reduce the time step, or choose the incremental coupling"};
}

template <int dim>
Limit density_gain_limit(double relaxation, double gradient_radius, double laplacian_radius) {
  return {.name = "number-density gain",
          .value = relaxation * density_gain<dim>(gradient_radius, laplacian_radius),
          .limit = 4.0 / 3.0,
          .unit = "of the deviation",
          .remedy = "relax the number density (gamma), or enlarge the gradient radius"};
}

Limit density_kick_limit(double time_step, double relaxation, double deviation, double spacing,
                         double speed) {
  return {.name = "number-density kick",
          .value = relaxation * deviation * spacing / time_step,
          .limit = speed,
          .unit = "m/s",
          .remedy =
              "start from a more even distribution, relax the number density (gamma), choose "
              "another source, or enlarge the time step"};
}

template Limit viscous_limit<2>(double, double, double, double);
template Limit viscous_limit<3>(double, double, double, double);
template Limit density_gain_limit<2>(double, double, double);
template Limit density_gain_limit<3>(double, double, double);

}  // namespace hemoscale::micro
