#include "micro/mps/semi_implicit_pressure.hpp"

#include <fmt/format.h>

#include "micro/error.hpp"
#include "micro/mps/pressure_gradient.hpp"
#include "micro/mps/semi_implicit_boundaries.hpp"
#include "micro/mps/semi_implicit_systems.hpp"

namespace hemoscale::micro {

namespace {

enum class Role { none, given, solved };

template <int dim>
const Outlet<dim>* outlet_around(const Openings<dim>& openings, const Vector<dim>& x) {
  for (const Outlet<dim>& outlet : openings.outlets) {
    if (outlet.normal.dot(x) > outlet.edge) return &outlet;
  }
  return nullptr;
}

template <int dim>
Role role_of(const SemiImplicitSetting<dim>& setting, const ParticleSet<dim>& particles,
             bool is_dry, std::size_t i) {
  switch (particles.kinds[i]) {
    case ParticleKind::fluid:
      return Role::solved;
    case ParticleKind::surface:
    case ParticleKind::outlet:
      return Role::given;
    case ParticleKind::wall:
      if (is_dry) return Role::given;
      return outlet_around(setting.openings, particles.positions[i]) ? Role::given : Role::solved;
    case ParticleKind::inlet:
      for (const Inlet<dim>& inlet : setting.openings.inlets) {
        const double behind = inlet.normal.dot(particles.positions[i]) - inlet.plane;
        if (inlet.patch == particles.patches[i] && behind < setting.spacing) return Role::solved;
      }
      return Role::none;
    case ParticleKind::dummy:
      return Role::none;
  }
  return Role::none;
}

/// Pressure of a particle whose pressure is given.
template <int dim>
double given_pressure(const SemiImplicitSetting<dim>& setting, const ParticleSet<dim>& particles,
                      std::size_t i, double t) {
  if (particles.kinds[i] == ParticleKind::surface) return 0;
  const Outlet<dim>* outlet = outlet_around(setting.openings, particles.positions[i]);
  if (outlet == nullptr) return 0;
  const Patch<dim>& patch = setting.patches[static_cast<std::size_t>(outlet->patch)];
  return patch.pressure ? patch.pressure(t) : 0;
}

/// What is unknown: the pressure, or its change; in `change`, known values set, others a first
/// guess.
template <int dim>
void set_known(const SemiImplicitSetting<dim>& setting, const SemiImplicitState<dim>& state,
               SemiImplicitWork<dim>& work, double t) {
  const ParticleSet<dim>& particles = state.particles;
  const bool is_incremental = setting.options.coupling == ParticleCoupling::incremental;
  const std::size_t count = particles.size();
  work.change.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    double value = is_incremental ? 0 : particles.pressures[i];
    if (work.has_pressure[i] == 0) value = 0;
    if (work.has_pressure[i] != 0 && work.solves_pressure[i] == 0) {
      value = given_pressure(setting, particles, i, t);
      if (is_incremental) value -= particles.pressures[i];
    }
    work.change[i] = value;
  }
}

/// Right-hand side of -lap p = -source, divided by the factors of the Laplacian.
template <int dim>
void fill_right(const SemiImplicitSetting<dim>& setting, SemiImplicitWork<dim>& work) {
  const NeighbourTable& table = work.table;
  const std::size_t count = table.size();
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    if (work.unknown[i] < 0) continue;
    const auto row = static_cast<std::size_t>(work.unknown[i]);
    work.pressure.solution[row] = work.change[i];
    if (work.solves_pressure[i] == 0) {
      work.pressure.right[row] = setting.kernel.laplacian_density * work.change[i];
      continue;
    }
    double right = -work.source[i] / work.laplacian.factors[i];
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      const std::size_t j = table[k];
      if (work.has_pressure[j] != 0 && work.solves_pressure[j] == 0) {
        right += work.laplacian.weights[k] * work.change[j];
      }
    }
    work.pressure.right[row] = right;
  }
}

/// Whether no particle has a given pressure.
template <int dim>
bool has_free_level(const SemiImplicitWork<dim>& work) {
  for (std::size_t i = 0; i < work.has_pressure.size(); ++i) {
    if (work.has_pressure[i] != 0 && work.solves_pressure[i] == 0) return false;
  }
  return true;
}

template <int dim>
void require_neighbours(const SemiImplicitState<dim>& state, const SemiImplicitWork<dim>& work) {
  for (std::size_t i = 0; i < work.unknown.size(); ++i) {
    if (work.solves_pressure[i] == 0) continue;
    const auto row = static_cast<std::size_t>(work.unknown[i]);
    const SparsePattern& pattern = *work.pattern;
    const std::size_t diagonal = pattern.entry(row, static_cast<std::int32_t>(row));
    if (work.pressure.matrix.values[diagonal] > 0) continue;
    throw NumericalError(fmt::format(
        "step {}, time {:.6g} s: particle {} has no neighbour with a pressure: a void has opened "
        "around it; reduce the time step, choose shifting, or name the free-surface ratio if it "
        "has left the fluid",
        state.step, state.time, state.particles.identities[i]));
  }
}

template <int dim>
void take_solution(const SemiImplicitSetting<dim>& setting, SemiImplicitState<dim>& state,
                   SemiImplicitWork<dim>& work) {
  std::vector<double>& pressures = state.particles.pressures;
  const bool is_incremental = setting.options.coupling == ParticleCoupling::incremental;
  for (std::size_t i = 0; i < pressures.size(); ++i) {
    if (work.has_pressure[i] == 0) {
      pressures[i] = 0;
      continue;
    }
    if (work.solves_pressure[i] != 0) {
      work.change[i] = work.pressure.solution[static_cast<std::size_t>(work.unknown[i])];
    }
    pressures[i] = is_incremental ? pressures[i] + work.change[i] : work.change[i];
  }
  work.report.clamped = 0;
  if (!setting.options.clamp_negative_pressure) return;
  for (std::size_t i = 0; i < pressures.size(); ++i) {
    if (pressures[i] >= 0) continue;
    work.change[i] -= pressures[i];
    pressures[i] = 0;
    ++work.report.clamped;
  }
}

}  // namespace

template <int dim>
void assign_pressure_roles(const SemiImplicitSetting<dim>& setting,
                           const SemiImplicitState<dim>& state, SemiImplicitWork<dim>& work) {
  const std::size_t count = state.particles.size();
  work.has_pressure.resize(count);
  work.solves_pressure.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_dry = !work.is_dry.empty() && work.is_dry[i] != 0;
    const Role role = role_of(setting, state.particles, is_dry, i);
    work.has_pressure[i] = static_cast<char>(role != Role::none);
    work.solves_pressure[i] = static_cast<char>(role == Role::solved);
  }
}

template <int dim>
void project(const SemiImplicitSetting<dim>& setting, SemiImplicitState<dim>& state,
             SemiImplicitWork<dim>& work, double dt) {
  ParticleSet<dim>& particles = state.particles;
  set_known(setting, state, work, state.time + dt);
  assemble(work, setting.kernel.laplacian_density, {}, work.has_pressure, work.solves_pressure,
           work.pressure.matrix);
  fill_right(setting, work);
  require_neighbours(state, work);
  const bool is_singular = has_free_level(work);
  prepare(setting, work, is_singular, work.pressure);
  const SolveReport solved = solve(state, "pressure", work.pressure);
  work.report.pressure_iterations = solved.iterations;
  work.report.relative_residual = solved.relative_residual;
  take_solution(setting, state, work);
  apply_pressure_gradient(setting.options.gradient_form, work.pressure_gradient, work.table,
                          work.change, work.lowest, work.vectors);
  const double factor = dt / setting.fluid.density;
  const std::size_t count = particles.size();
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_free(particles.kinds[i])) continue;
    const Vector<dim> correction = factor * work.vectors[i];
    particles.velocities[i] -= correction;
    particles.positions[i] -= dt * correction;
  }
}

#define HEMOSCALE_INSTANTIATE(dim)                                                                 \
  template void assign_pressure_roles<dim>(const SemiImplicitSetting<dim>&,                        \
                                           const SemiImplicitState<dim>&, SemiImplicitWork<dim>&); \
  template void project<dim>(const SemiImplicitSetting<dim>&, SemiImplicitState<dim>&,             \
                             SemiImplicitWork<dim>&, double);
HEMOSCALE_INSTANTIATE(2)
HEMOSCALE_INSTANTIATE(3)
#undef HEMOSCALE_INSTANTIATE

}  // namespace hemoscale::micro
