#include "micro/mps/semi_implicit_boundaries.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "micro/error.hpp"
#include "micro/mps/semi_implicit_neighbours.hpp"
#include "micro/particles/weight.hpp"

namespace hemoscale::micro {

namespace {

constexpr double probe_radius = 1.8;  // [l0] reaches two rows on either side; none beyond

template <int dim>
const Outlet<dim>& outlet_of(const Openings<dim>& openings, std::int32_t patch) {
  return *std::find_if(openings.outlets.begin(), openings.outlets.end(),
                       [&](const Outlet<dim>& outlet) { return outlet.patch == patch; });
}

bool is_wall(ParticleKind kind) {
  return kind == ParticleKind::wall || kind == ParticleKind::dummy;
}

/// Where the particle looks for the velocity of the fluid.
template <int dim>
Vector<dim> probe_place(const SemiImplicitSetting<dim>& setting,
                        const SemiImplicitState<dim>& state, std::size_t i) {
  const Vector<dim>& x = state.particles.positions[i];
  const Vector<dim>& n = state.particles.normals[i];
  if (is_wall(state.particles.kinds[i])) return x - 2 * state.depths[i] * n;
  const Outlet<dim>& outlet = outlet_of(setting.openings, state.particles.patches[i]);
  return x - (n.dot(x) - outlet.edge + setting.spacing) * n;
}

/// Value at `place` of the linear function that fits the normal velocities of the fluid around it.
template <int dim>
double fitted_speed(const SemiImplicitSetting<dim>& setting, const SemiImplicitState<dim>& state,
                    const SemiImplicitWork<dim>& work, std::size_t probe, const Vector<dim>& place,
                    const Vector<dim>& normal) {
  using Basis = Eigen::Matrix<double, dim + 1, 1>;
  using Moments = Eigen::Matrix<double, dim + 1, dim + 1>;
  Moments moments = Moments::Zero();
  Basis sums = Basis::Zero();
  const double radius = probe_radius * setting.spacing;
  for (const std::int32_t neighbour : work.probe_table.of(probe)) {
    const auto k = static_cast<std::size_t>(neighbour);
    if (k >= work.probe_sources.size()) continue;
    const auto j = static_cast<std::size_t>(work.probe_sources[k]);
    const Vector<dim> r = separation(setting.box, place, state.particles.positions[j]);
    const double weight = compact_weight(r.norm(), radius);
    Basis basis;
    basis << 1, r / setting.spacing;
    moments += weight * basis * basis.transpose();
    sums += weight * normal.dot(state.particles.velocities[j]) * basis;
  }
  const Eigen::LDLT<Moments> factors(moments);
  if (factors.info() != Eigen::Success || !(factors.rcond() > 1e-10)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return factors.solve(sums)[0];
}

}  // namespace

template <int dim>
std::vector<double> wall_depths(const FlowDomain<dim>& domain) {
  const ParticleSet<dim>& particles = domain.particles;
  std::vector<std::size_t> walls;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.kinds[i] == ParticleKind::wall) walls.push_back(i);
  }
  std::vector<double> depths(particles.size(), 0.0);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (!is_wall(particles.kinds[i])) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::size_t w : walls) {
      nearest = std::min(
          nearest,
          separation(domain.box, particles.positions[i], particles.positions[w]).squaredNorm());
    }
    depths[i] = std::sqrt(nearest) + domain.spacing / 2;
  }
  return depths;
}

template <int dim>
void find_probes(const SemiImplicitSetting<dim>& setting, const SemiImplicitState<dim>& state,
                 SemiImplicitWork<dim>& work) {
  const ParticleSet<dim>& particles = state.particles;
  const bool mirrors = setting.options.wall_velocity == WallVelocity::antisymmetric;
  work.probes.clear();
  work.probe_sources.clear();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const ParticleKind kind = particles.kinds[i];
    const bool looks = kind == ParticleKind::outlet || (mirrors && is_wall(kind));
    if (looks) work.probes.push_back(static_cast<std::int32_t>(i));
    if (is_free(kind)) work.probe_sources.push_back(static_cast<std::int32_t>(i));
  }
  if (work.probes.empty()) return;
  std::vector<Vector<dim>> places;
  places.reserve(work.probe_sources.size() + work.probes.size());
  for (const std::int32_t i : work.probe_sources) {
    places.push_back(state.table_positions[static_cast<std::size_t>(i)]);
  }
  for (const std::int32_t i : work.probes) {
    places.push_back(probe_place(setting, state, static_cast<std::size_t>(i)));
  }
  // The fluid moves by half of the skin of the main table at most before this table is made anew.
  work.probe_table.build(places, setting.box, probe_radius * setting.spacing,
                         neighbour_skin * setting.spacing);
}

template <int dim>
void impose_velocities(const SemiImplicitSetting<dim>& setting, double t,
                       ParticleSet<dim>& particles) {
  const std::size_t count = particles.size();
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    if (is_free(particles.kinds[i]) || particles.kinds[i] == ParticleKind::outlet) continue;
    const auto patch = static_cast<std::size_t>(particles.patches[i]);
    particles.velocities[i] = patch_velocity(setting.patches[patch], particles.positions[i], t);
  }
}

template <int dim>
void extrapolate_to_outlets(const SemiImplicitSetting<dim>& setting, SemiImplicitState<dim>& state,
                            const SemiImplicitWork<dim>& work) {
  ParticleSet<dim>& particles = state.particles;
  const std::size_t first_probe = work.probe_sources.size();
  for (std::size_t k = 0; k < work.probes.size(); ++k) {
    const auto i = static_cast<std::size_t>(work.probes[k]);
    if (particles.kinds[i] != ParticleKind::outlet) continue;
    const Vector<dim>& normal = particles.normals[i];
    const double speed =
        fitted_speed(setting, state, work, first_probe + k, probe_place(setting, state, i), normal);
    if (!std::isfinite(speed)) {
      throw NumericalError(fmt::format(
          "step {}, time {:.6g} s: outlet particle {} finds no fluid before the outlet to take its "
          "velocity from: a void; reduce the time step, or move the outlet downstream",
          state.step, state.time, particles.identities[i]));
    }
    particles.velocities[i] = speed * normal;
  }
}

template <int dim>
void see_velocities(const SemiImplicitSetting<dim>& setting, const SemiImplicitState<dim>& state,
                    SemiImplicitWork<dim>& work) {
  const ParticleSet<dim>& particles = state.particles;
  work.viscous_velocities = particles.velocities;
  if (setting.options.wall_velocity == WallVelocity::dummy) return;
  const std::size_t first_probe = work.probe_sources.size();
  const double radius = probe_radius * setting.spacing;
#pragma omp parallel for schedule(static)
  for (std::size_t p = 0; p < work.probes.size(); ++p) {
    const auto i = static_cast<std::size_t>(work.probes[p]);
    if (!is_wall(particles.kinds[i])) continue;
    const Vector<dim>& wall_velocity = particles.velocities[i];
    const Vector<dim> place = probe_place(setting, state, i);
    const double depth = state.depths[i];
    Vector<dim> sum = Vector<dim>::Zero();
    double moment = 0;
    for (const std::int32_t neighbour : work.probe_table.of(first_probe + p)) {
      const auto k = static_cast<std::size_t>(neighbour);
      if (k >= first_probe) continue;
      const auto j = static_cast<std::size_t>(work.probe_sources[k]);
      const Vector<dim> r = separation(setting.box, place, particles.positions[j]);
      const double weight = compact_weight(r.norm(), radius);
      sum += weight * (particles.velocities[j] - wall_velocity);
      moment += weight * (depth - particles.normals[i].dot(r));
    }
    if (moment > 0) work.viscous_velocities[i] = wall_velocity - depth / moment * sum;
  }
}

#define HEMOSCALE_INSTANTIATE(dim)                                                               \
  template std::vector<double> wall_depths<dim>(const FlowDomain<dim>&);                         \
  template void find_probes<dim>(const SemiImplicitSetting<dim>&, const SemiImplicitState<dim>&, \
                                 SemiImplicitWork<dim>&);                                        \
  template void impose_velocities<dim>(const SemiImplicitSetting<dim>&, double,                  \
                                       ParticleSet<dim>&);                                       \
  template void extrapolate_to_outlets<dim>(                                                     \
      const SemiImplicitSetting<dim>&, SemiImplicitState<dim>&, const SemiImplicitWork<dim>&);   \
  template void see_velocities<dim>(const SemiImplicitSetting<dim>&,                             \
                                    const SemiImplicitState<dim>&, SemiImplicitWork<dim>&);
HEMOSCALE_INSTANTIATE(2)
HEMOSCALE_INSTANTIATE(3)
#undef HEMOSCALE_INSTANTIATE

}  // namespace hemoscale::micro
