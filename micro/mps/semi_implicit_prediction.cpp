#include "micro/mps/semi_implicit_prediction.hpp"

#include "micro/mps/pressure_gradient.hpp"
#include "micro/mps/semi_implicit_boundaries.hpp"
#include "micro/mps/semi_implicit_systems.hpp"

namespace hemoscale::micro {

namespace {

/// nu lap u of the free particles, added to `rates`.
template <int dim>
void add_viscous_rates(const SemiImplicitSetting<dim>& setting, const SemiImplicitState<dim>& state,
                       const SemiImplicitWork<dim>& work, std::vector<Vector<dim>>& rates) {
  const NeighbourTable& table = work.table;
  const double viscosity = setting.fluid.kinematic_viscosity;
  const std::vector<Vector<dim>>& u = work.viscous_velocities;
  const std::size_t count = table.size();
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_free(state.particles.kinds[i])) continue;
    Vector<dim> sum = Vector<dim>::Zero();
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      sum += work.laplacian.weights[k] * (u[table[k]] - u[i]);
    }
    rates[i] += viscosity * work.laplacian.factors[i] * sum;
  }
}

/// Body force, forces on single particles, and the old pressure where the coupling wants it
/// [m/s^2].
template <int dim>
void driving_rates(const SemiImplicitSetting<dim>& setting, const SemiImplicitState<dim>& state,
                   SemiImplicitWork<dim>& work, double dt, std::vector<Vector<dim>>& rates) {
  const Vector<dim> force = setting.acceleration ? setting.acceleration(state.time + dt)
                                                 : Vector<dim>(Vector<dim>::Zero());
  if (setting.options.coupling == ParticleCoupling::chorin) {
    rates.assign(state.particles.size(), force);
  } else {
    apply_pressure_gradient(setting.options.gradient_form, work.pressure_gradient, work.table,
                            state.particles.pressures, work.lowest, rates);
    for (Vector<dim>& rate : rates) rate = force - rate / setting.fluid.density;
  }
  if (setting.local_acceleration) {
    setting.local_acceleration(state.particles, state.time + dt, rates);
  }
}

/// (1 - dt nu lap) u = u + dt rates, divided by the factors of the Laplacian and dt nu.
template <int dim>
void solve_viscous(const SemiImplicitSetting<dim>& setting, SemiImplicitState<dim>& state,
                   SemiImplicitWork<dim>& work, double dt, const std::vector<Vector<dim>>& rates) {
  ParticleSet<dim>& particles = state.particles;
  const NeighbourTable& table = work.table;
  const std::size_t count = particles.size();
  std::vector<double> extra(count);
  std::vector<char> solved(count);
  for (std::size_t i = 0; i < count; ++i) {
    solved[i] = static_cast<char>(is_free(particles.kinds[i]));
    extra[i] = 1 / (dt * setting.fluid.kinematic_viscosity * work.laplacian.factors[i]);
  }
  const std::vector<char> counts(count, 1);
  assemble(work, setting.kernel.laplacian_density, extra, counts, solved, work.velocity.matrix);
  prepare(setting, work, false, work.velocity);
  for (int axis = 0; axis < dim; ++axis) {
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < count; ++i) {
      if (work.unknown[i] < 0) continue;
      const auto row = static_cast<std::size_t>(work.unknown[i]);
      work.velocity.solution[row] = particles.velocities[i][axis];
      if (solved[i] == 0) {
        work.velocity.right[row] = setting.kernel.laplacian_density * particles.velocities[i][axis];
        continue;
      }
      double right = extra[i] * (particles.velocities[i][axis] + dt * rates[i][axis]);
      for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
        const std::size_t j = table[k];
        if (solved[j] == 0) right += work.laplacian.weights[k] * work.viscous_velocities[j][axis];
      }
      work.velocity.right[row] = right;
    }
    work.report.velocity_iterations += solve(state, "implicit viscosity", work.velocity).iterations;
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < count; ++i) {
      if (solved[i] == 0) continue;
      particles.velocities[i][axis] =
          work.velocity.solution[static_cast<std::size_t>(work.unknown[i])];
    }
  }
}

}  // namespace

template <int dim>
void predict(const SemiImplicitSetting<dim>& setting, SemiImplicitState<dim>& state,
             SemiImplicitWork<dim>& work, double dt) {
  work.report.velocity_iterations = 0;
  driving_rates(setting, state, work, dt, work.vectors);
  const bool is_implicit = setting.options.viscosity == ViscousStepping::implicit_euler;
  // Explicit: neighbours as they are now; implicit: boundaries as they will be.
  if (is_implicit) {
    impose_velocities(setting, state.time + dt, state.particles);
    extrapolate_to_outlets(setting, state, work);
  }
  see_velocities(setting, state, work);
  if (is_implicit && setting.fluid.kinematic_viscosity > 0) {
    solve_viscous(setting, state, work, dt, work.vectors);
    return;
  }
  add_viscous_rates(setting, state, work, work.vectors);
  const std::size_t count = state.particles.size();
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    if (is_free(state.particles.kinds[i])) state.particles.velocities[i] += dt * work.vectors[i];
  }
  impose_velocities(setting, state.time + dt, state.particles);
  extrapolate_to_outlets(setting, state, work);
}

template void predict<2>(const SemiImplicitSetting<2>&, SemiImplicitState<2>&, SemiImplicitWork<2>&,
                         double);
template void predict<3>(const SemiImplicitSetting<3>&, SemiImplicitState<3>&, SemiImplicitWork<3>&,
                         double);

}  // namespace hemoscale::micro
