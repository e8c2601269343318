#include "micro/mps/semi_implicit_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "micro/error.hpp"
#include "micro/mps/semi_implicit_boundaries.hpp"

namespace hemoscale::micro {

namespace {

/// Sums over the fluid, particle after particle: the same bits for any number of threads.
template <int dim>
void survey(const SemiImplicitSetting<dim>& setting, const SemiImplicitState<dim>& state,
            const SemiImplicitWork<dim>& work, SemiImplicitReport& report) {
  const ParticleSet<dim>& particles = state.particles;
  double squares = 0;
  double fastest = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (!is_free(particles.kinds[i])) continue;
    const double square = particles.velocities[i].squaredNorm();
    squares += square;
    fastest = std::max(fastest, square);
  }
  const double volume = std::pow(setting.spacing, dim);
  report.kinetic_energy = 0.5 * setting.fluid.density * volume * squares;
  report.fastest = std::sqrt(fastest);
  report.density_error = density_deviation(setting, state, work.density);
  double nearest = std::numeric_limits<double>::infinity();
  for (const double distance : work.pairs.distances) nearest = std::min(nearest, distance);
  report.nearest = nearest / setting.spacing;
}

template <int dim>
[[noreturn]] void fail(const SemiImplicitState<dim>& state, const std::vector<Limit>& limits,
                       std::size_t particle, const std::string& what) {
  const Vector<dim>& x = state.particles.positions[particle];
  std::string place = fmt::format("{:.6g}", x[0]);
  for (int axis = 1; axis < dim; ++axis) place += fmt::format(", {:.6g}", x[axis]);
  throw NumericalError(fmt::format("step {}, time {:.6g} s: particle {} at ({}) m: {}; {}",
                                   state.step, state.time, state.particles.identities[particle],
                                   place, what, diagnosis(limits)));
}

template <int dim>
void require_finite(const SemiImplicitState<dim>& state, const std::vector<Limit>& limits) {
  const ParticleSet<dim>& particles = state.particles;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (!particles.positions[i].allFinite() || !particles.velocities[i].allFinite() ||
        !std::isfinite(particles.pressures[i])) {
      fail(state, limits, i, "position, velocity or pressure is not finite");
    }
  }
}

template <int dim>
void require_inside(const SemiImplicitSetting<dim>& setting, const SemiImplicitState<dim>& state,
                    const std::vector<Limit>& limits) {
  for (std::size_t i = 0; i < state.particles.size(); ++i) {
    for (int axis = 0; axis < dim; ++axis) {
      if (setting.box.periodic[static_cast<std::size_t>(axis)]) continue;
      const double x = state.particles.positions[i][axis];
      if (x >= setting.lower[axis] && x <= setting.upper[axis]) continue;
      fail(state, limits, i,
           fmt::format("it left the domain, which extends from {:.6g} to {:.6g} m along axis {}",
                       setting.lower[axis], setting.upper[axis], axis));
    }
  }
}

template <int dim>
void require_distances(const SemiImplicitSetting<dim>& setting, const SemiImplicitState<dim>& state,
                       const SemiImplicitWork<dim>& work, const std::vector<Limit>& limits) {
  if (work.report.nearest < SemiImplicitThresholds::nearest) {
    for (std::size_t i = 0; i < work.table.size(); ++i) {
      for (std::size_t k = work.table.begin(i); k < work.table.end(i); ++k) {
        const double distance = work.pairs.distances[k] / setting.spacing;
        if (distance >= SemiImplicitThresholds::nearest) continue;
        fail(state, limits, i,
             fmt::format("its distance from particle {} is {:.4g} spacings, at least {:g} is "
                         "admitted: particles meet",
                         state.particles.identities[work.table[k]], distance,
                         SemiImplicitThresholds::nearest));
      }
    }
  }
  if (setting.options.free_surface_ratio) return;
  for (std::size_t i = 0; i < work.density.size(); ++i) {
    if (state.particles.kinds[i] != ParticleKind::fluid) continue;
    const double share = work.density[i] / setting.kernel.gradient_density;
    if (share >= SemiImplicitThresholds::void_density) continue;
    fail(state, limits, i,
         fmt::format("its number density is {:.4g} of that of the lattice, at least {:g} is "
                     "admitted: a void has opened",
                     share, SemiImplicitThresholds::void_density));
  }
}

template <int dim>
void require_calm(const SemiImplicitSetting<dim>& setting, const SemiImplicitState<dim>& state,
                  const SemiImplicitWork<dim>& work, const std::vector<Limit>& limits) {
  const ParticleSet<dim>& particles = state.particles;
  const auto fastest = static_cast<std::size_t>(
      std::distance(particles.velocities.begin(),
                    std::max_element(particles.velocities.begin(), particles.velocities.end(),
                                     [](const Vector<dim>& a, const Vector<dim>& b) {
                                       return a.squaredNorm() < b.squaredNorm();
                                     })));
  const double speed = setting.options.speed;
  if (work.report.fastest > SemiImplicitThresholds::runaway_speed * speed) {
    fail(state, limits, fastest,
         fmt::format("its speed is {:.4g} m/s, at most {:.4g} m/s ({:g} times the characteristic "
                     "one) is admitted",
                     work.report.fastest, SemiImplicitThresholds::runaway_speed * speed,
                     SemiImplicitThresholds::runaway_speed));
  }
  const auto free =
      static_cast<double>(std::count_if(particles.kinds.begin(), particles.kinds.end(), is_free));
  const double unit =
      0.5 * setting.fluid.density * std::pow(setting.spacing, dim) * free * speed * speed;
  if (work.report.kinetic_energy > SemiImplicitThresholds::kinetic_energy * unit) {
    fail(state, limits, fastest,
         fmt::format("the kinetic energy has grown to {:.4g} times that of the characteristic "
                     "speed, at most {:g} is admitted; this particle is the fastest",
                     work.report.kinetic_energy / unit, SemiImplicitThresholds::kinetic_energy));
  }
}

}  // namespace

std::string diagnosis(const std::vector<Limit>& limits) {
  std::string text;
  for (const Limit& limit : limits) {
    if (limit.exceeded()) text += (text.empty() ? "" : "; ") + describe(limit);
  }
  return text.empty()
             ? "no limit is exceeded: choose another scheme (shifting, corrected gradient, "
               "implicit viscosity) or another time step"
             : text;
}

template <int dim>
std::vector<Limit> semi_implicit_limits(const SemiImplicitOptions& options, const Fluid& fluid,
                                        double spacing, double time_step, double deviation) {
  std::vector<Limit> limits = {advective_limit(time_step, options.speed, spacing)};
  if (options.viscosity == ViscousStepping::explicit_euler) {
    limits.push_back(
        viscous_limit<dim>(time_step, fluid.kinematic_viscosity, spacing, options.laplacian_ratio));
  }
  if (options.coupling == ParticleCoupling::chorin && options.gap > 0) {
    limits.push_back(splitting_limit(time_step, fluid.kinematic_viscosity, options.gap));
  }
  if (options.source == IncompressibilitySource::pnd) {
    limits.push_back(density_gain_limit<dim>(options.relaxation, options.gradient_ratio,
                                             options.laplacian_ratio));
    limits.push_back(
        density_kick_limit(time_step, options.relaxation, deviation, spacing, options.speed));
  }
  return limits;
}

template <int dim>
double density_deviation(const SemiImplicitSetting<dim>& setting,
                         const SemiImplicitState<dim>& state, const std::vector<double>& density) {
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < density.size(); ++i) {
    if (state.particles.kinds[i] != ParticleKind::fluid) continue;
    const double deviation = density[i] / setting.kernel.gradient_density - 1;
    squares += deviation * deviation;
    ++count;
  }
  return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0;
}

template <int dim>
void watch(const SemiImplicitSetting<dim>& setting, const SemiImplicitState<dim>& state,
           SemiImplicitWork<dim>& work, const std::vector<Limit>& limits) {
  require_finite(state, limits);
  survey(setting, state, work, work.report);
  require_inside(setting, state, limits);
  require_distances(setting, state, work, limits);
  require_calm(setting, state, work, limits);
}

#define HEMOSCALE_INSTANTIATE(dim)                                                                \
  template void watch<dim>(const SemiImplicitSetting<dim>&, const SemiImplicitState<dim>&,        \
                           SemiImplicitWork<dim>&, const std::vector<Limit>&);                    \
  template std::vector<Limit> semi_implicit_limits<dim>(const SemiImplicitOptions&, const Fluid&, \
                                                        double, double, double);                  \
  template double density_deviation<dim>(                                                         \
      const SemiImplicitSetting<dim>&, const SemiImplicitState<dim>&, const std::vector<double>&);
HEMOSCALE_INSTANTIATE(2)
HEMOSCALE_INSTANTIATE(3)
#undef HEMOSCALE_INSTANTIATE

}  // namespace hemoscale::micro
