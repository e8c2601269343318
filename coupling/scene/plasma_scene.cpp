#include "coupling/scene/plasma_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "coupling/scene/plasma_flows.hpp"
#include "coupling/scene/plasma_method.hpp"
#include "micro/mps/stage_limits.hpp"

namespace hemoscale::coupling {

namespace {

const std::string prefix = "micro.plasma.";

/// The step of a case that gives none.
template <int dim>
double default_step(const PlasmaScene<dim>& scene, double interval) {
  const double spacing = scene.domain.spacing;
  if (const auto* stage = std::get_if<micro::StageOptions>(&scene.method)) {
    // Steady states one after the other have no step of their own.
    const bool is_free = stage->inertia == micro::Inertia::quasi_steady &&
                         stage->motion == micro::NodeMotion::eulerian;
    if (is_free) return interval;
  }
  double step = scene.speed > 0 ? 0.2 * spacing / scene.speed : 0;
  const double nu = scene.fluid.kinematic_viscosity;
  const bool is_explicit = std::visit(
      [](const auto& options) { return is_explicit_in_viscosity(options); }, scene.method);
  if (is_explicit && nu > 0) {
    // Two fifths of the limit of either operator, whose largest eigenvalues are near 4 / l0^2.
    const double viscous = 0.2 * spacing * spacing / nu;
    step = step > 0 ? std::min(step, viscous) : viscous;
  }
  return step;
}

}  // namespace

int plasma_dimension(const Settings& settings) {
  const std::string& flow = settings.text(prefix + "flow");
  return flow == "pipe" || flow == "taylor-green-3d" ? 3 : 2;
}

template <int dim>
PlasmaScene<dim> build_plasma_scene(const Settings& settings, bool force) {
  PlasmaScene<dim> scene;
  scene.method = build_plasma_method(settings);
  scene.fluid.density = settings.quantity("fluid.density");
  scene.fluid.kinematic_viscosity =
      settings.quantity("fluid.plasma_viscosity") / scene.fluid.density;
  build_plasma_flow(settings, scene);
  scene.mean_speed =
      settings.has(prefix + "speed") ? settings.quantity(prefix + "speed") : scene.speed;
  if (auto* semi = std::get_if<micro::SemiImplicitOptions>(&scene.method)) {
    semi->force = force;
    semi->speed = scene.speed;
    // Only an open channel is driven by pressure, which the splitting error comes from.
    const std::string& flow = settings.text(prefix + "flow");
    if (flow == "open-channel") semi->gap = scene.size;
    if (flow == "column" || flow == "rotating-patch") semi->free_surface_ratio = 0.97;
    micro::require_admissible(*semi);
  }
  scene.time_step = settings.has(prefix + "time_step")
                        ? settings.quantity(prefix + "time_step")
                        : default_step(scene, settings.quantity("micro.output_interval"));
  return scene;
}

template <int dim>
std::vector<micro::Limit> plasma_limits(const PlasmaScene<dim>& scene) {
  if (const auto* stage = std::get_if<micro::StageOptions>(&scene.method)) {
    return micro::stage_limits<dim>(*stage, scene.fluid, scene.domain.spacing, scene.time_step,
                                    {.speed = scene.speed, .gap = scene.sections ? scene.size : 0});
  }
  // The deviation of the density is that of the particles themselves; the stepper measures it.
  const micro::SemiImplicitStepper<dim> stepper(scene.domain, scene.fluid,
                                                std::get<micro::SemiImplicitOptions>(scene.method));
  return stepper.limits(scene.time_step);
}

double longest_step(const std::vector<micro::Limit>& limits, double time_step) {
  double longest = std::numeric_limits<double>::infinity();
  for (const micro::Limit& limit : limits) {
    // Those of the number density ask for longer steps, not shorter ones.
    if (limit.name.rfind("number-density", 0) == 0 || !(limit.value > 0)) continue;
    longest = std::min(longest, time_step * limit.limit / limit.value);
  }
  return longest;
}

template PlasmaScene<2> build_plasma_scene<2>(const Settings&, bool);
template PlasmaScene<3> build_plasma_scene<3>(const Settings&, bool);
template std::vector<micro::Limit> plasma_limits<2>(const PlasmaScene<2>&);
template std::vector<micro::Limit> plasma_limits<3>(const PlasmaScene<3>&);

namespace {

template <int dim>
std::string describe(const Settings& settings) {
  const PlasmaScene<dim> scene = build_plasma_scene<dim>(settings, true);
  const double nu = scene.fluid.kinematic_viscosity;
  std::string text = fmt::format(
      "plasma: {}, {} particles {:.4g} m apart, scheme {}\n"
      "  Reynolds number {:.4g} (speed {:.4g} m/s, size {:.4g} m, viscosity {:.4g} m^2/s)\n"
      "  step {:.4g} s\n",
      settings.text(prefix + "flow"), scene.domain.particles.size(), scene.domain.spacing,
      settings.text(prefix + "scheme"), nu > 0 ? scene.mean_speed * scene.size / nu : 0.0,
      scene.mean_speed, scene.size, nu, scene.time_step);
  for (const micro::Limit& limit : plasma_limits(scene)) {
    text += fmt::format("  {}: {:.4g} of {:.4g} {}\n", limit.name, limit.value, limit.limit,
                        limit.unit);
  }
  return text;
}

}  // namespace

std::string describe_plasma(const Settings& settings) {
  return plasma_dimension(settings) == 3 ? describe<3>(settings) : describe<2>(settings);
}

}  // namespace hemoscale::coupling
