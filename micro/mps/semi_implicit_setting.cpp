#include "micro/mps/semi_implicit_setting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "micro/error.hpp"
#include "micro/linear/aggregate_solver.hpp"
#include "micro/mps/semi_implicit_boundaries.hpp"

namespace hemoscale::micro {

namespace {

void check_fluid(const Fluid& fluid) {
  if (!(fluid.density > 0)) {
    throw ParameterError(
        fmt::format("the density is {:g} kg/m^3; it must be positive", fluid.density));
  }
  if (!(fluid.kinematic_viscosity >= 0)) {
    throw ParameterError(
        fmt::format("the kinematic viscosity is {:g} m^2/s; it must not be negative",
                    fluid.kinematic_viscosity));
  }
}

template <int dim>
void check_domain(const FlowDomain<dim>& domain) {
  const ParticleSet<dim>& particles = domain.particles;
  if (domain.sliding_rate != 0 || domain.box.slide != 0) {
    throw ParameterError(
        "the box slides; the semi-implicit stepper has no sheared boxes; choose the least-squares "
        "stepper");
  }
  if (std::none_of(particles.kinds.begin(), particles.kinds.end(), is_free)) {
    throw ParameterError("the domain has no fluid particle; enlarge it or reduce the spacing");
  }
  bool has_wall = false;
  bool has_dummy = false;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    has_wall = has_wall || particles.kinds[i] == ParticleKind::wall;
    has_dummy = has_dummy || particles.kinds[i] == ParticleKind::dummy;
    const auto patch = particles.patches[i];
    const auto patches = static_cast<std::int32_t>(domain.patches.size());
    if (!is_free(particles.kinds[i]) && (patch < 0 || patch >= patches)) {
      throw ParameterError(fmt::format(
          "particle {} of the boundary belongs to patch {}; the domain has {}; name its patch", i,
          patch, patches));
    }
  }
  if (has_dummy && !has_wall) {
    throw ParameterError(
        "the domain has dummy particles but no wall particles; make the layer next "
        "to the fluid wall particles");
  }
}

/// Bounds of box and particles, and one spacing more.
template <int dim>
void find_bounds(const FlowDomain<dim>& domain, SemiImplicitSetting<dim>& setting) {
  setting.lower = domain.box.lower;
  setting.upper = domain.box.upper;
  for (const Vector<dim>& x : domain.particles.positions) {
    setting.lower = setting.lower.cwiseMin(x);
    setting.upper = setting.upper.cwiseMax(x);
  }
  setting.lower.array() -= domain.spacing;
  setting.upper.array() += domain.spacing;
}

}  // namespace

template <int dim>
SemiImplicitSetting<dim> make_setting(const FlowDomain<dim>& domain, const Fluid& fluid,
                                      const SemiImplicitOptions& options,
                                      const SolveTolerance& tolerance,
                                      SymmetricSolverFactory<dim> make_solver) {
  require_admissible(options);
  check_fluid(fluid);
  check_domain(domain);
  SemiImplicitSetting<dim> setting;
  setting.options = options;
  setting.fluid = fluid;
  setting.spacing = domain.spacing;
  setting.kernel = mps_kernel<dim>(domain.spacing, options.gradient_ratio, options.laplacian_ratio);
  setting.box = domain.box;
  setting.patches = domain.patches;
  setting.acceleration = domain.acceleration;
  setting.local_acceleration = domain.local_acceleration;
  setting.local_limits = domain.local_limits;
  setting.openings = find_openings(domain);
  find_bounds(domain, setting);
  setting.tolerance = tolerance;
  setting.make_solver = std::move(make_solver);
  if (!setting.make_solver) {
    setting.make_solver = [](const NodeLayout<dim>& layout, const SolveTolerance& wanted,
                             const std::optional<ConstantNullSpace>& null_space) {
      return std::make_unique<AggregateSolver<dim>>(layout, true, wanted, null_space);
    };
  }
  return setting;
}

template <int dim>
SemiImplicitState<dim> make_state(const FlowDomain<dim>& domain) {
  SemiImplicitState<dim> state;
  state.particles = domain.particles;
  state.depths = wall_depths(domain);
  std::int64_t largest = -1;
  for (const std::int64_t identity : domain.particles.identities) {
    largest = std::max(largest, identity);
  }
  state.ledger.next_identity = largest + 1;
  state.ledger.initial = count_moving(domain.particles);
  return state;
}

#define HEMOSCALE_INSTANTIATE(dim)                                                             \
  template SemiImplicitSetting<dim> make_setting<dim>(                                         \
      const FlowDomain<dim>&, const Fluid&, const SemiImplicitOptions&, const SolveTolerance&, \
      SymmetricSolverFactory<dim>);                                                            \
  template SemiImplicitState<dim> make_state<dim>(const FlowDomain<dim>&);
HEMOSCALE_INSTANTIATE(2)
HEMOSCALE_INSTANTIATE(3)
#undef HEMOSCALE_INSTANTIATE

}  // namespace hemoscale::micro
