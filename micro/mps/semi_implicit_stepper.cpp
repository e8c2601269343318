#include "micro/mps/semi_implicit_stepper.hpp"

#include <fmt/format.h>

#include <chrono>
#include <string>

#include "micro/error.hpp"
#include "micro/mps/number_density.hpp"
#include "micro/mps/semi_implicit_boundaries.hpp"
#include "micro/mps/semi_implicit_coefficients.hpp"
#include "micro/mps/semi_implicit_neighbours.hpp"
#include "micro/mps/semi_implicit_prediction.hpp"
#include "micro/mps/semi_implicit_pressure.hpp"
#include "micro/mps/semi_implicit_setting.hpp"
#include "micro/mps/semi_implicit_shifting.hpp"
#include "micro/mps/semi_implicit_snapshot.hpp"
#include "micro/mps/semi_implicit_source.hpp"
#include "micro/mps/semi_implicit_watch.hpp"

namespace hemoscale::micro {

namespace {

/// Runs a stage and adds its wall time to `spent`.
template <typename Stage>
void timed(double& spent, const Stage& stage) {
  const auto start = std::chrono::steady_clock::now();
  stage();
  spent += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <int dim>
void move(ParticleSet<dim>& particles, double dt) {
  const std::size_t count = particles.size();
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    const ParticleKind kind = particles.kinds[i];
    if (kind == ParticleKind::wall || kind == ParticleKind::dummy) continue;
    particles.positions[i] += dt * particles.velocities[i];
  }
}

/// The message with step and time in front, and the limits that are exceeded, where it lacks them.
std::string completed(const std::string& message, std::int64_t step, double time,
                      const std::vector<Limit>& limits) {
  std::string text = message;
  if (text.rfind("step ", 0) != 0)
    text = fmt::format("step {}, time {:.6g} s: {}", step, time, text);
  for (const Limit& limit : limits) {
    if (limit.exceeded() && text.find(limit.name) == std::string::npos) {
      text += "; " + describe(limit);
    }
  }
  return text;
}

}  // namespace

template <int dim>
SemiImplicitStepper<dim>::SemiImplicitStepper(const FlowDomain<dim>& domain, const Fluid& fluid,
                                              const SemiImplicitOptions& options,
                                              const SolveTolerance& tolerance,
                                              SymmetricSolverFactory<dim> make_solver)
    : setting_(make_setting(domain, fluid, options, tolerance, std::move(make_solver))),
      state_(make_state(domain)) {
  impose_velocities(setting_, state_.time, state_.particles);
  refresh_neighbours(setting_, state_, work_);
  measure_pairs(state_.particles.positions, setting_.box, work_.table, work_.pairs);
  number_density(setting_.kernel, work_.pairs, work_.table, work_.density);
  if (!options.free_surface_ratio) deviation_ = density_deviation(setting_, state_, work_.density);
}

template <int dim>
std::vector<Limit> SemiImplicitStepper<dim>::limits(double dt) const {
  std::vector<Limit> limits =
      semi_implicit_limits<dim>(setting_.options, setting_.fluid, setting_.spacing, dt, deviation_);
  if (setting_.local_limits) {
    for (const Limit& limit : setting_.local_limits(dt)) limits.push_back(limit);
  }
  return limits;
}

template <int dim>
void SemiImplicitStepper<dim>::step(double dt) {
  if (!(dt > 0)) {
    throw ParameterError(fmt::format("the time step is {:g} s; it must be positive", dt));
  }
  if (dt != limits_step_) {
    limits_ = limits(dt);
    limits_step_ = dt;
  }
  require_within(limits_, setting_.options.force);
  last_good_ = state_;
  try {
    advance(dt);
  } catch (const NumericalError& error) {
    const std::string message = completed(error.what(), state_.step, state_.time, limits_);
    revert();
    throw NumericalError(message);
  }
}

template <int dim>
void SemiImplicitStepper<dim>::revert() {
  std::swap(state_, last_good_);
  resume();
}

template <int dim>
void SemiImplicitStepper<dim>::advance(double dt) {
  SemiImplicitTimes& times = work_.times;
  timed(times.neighbours, [&] {
    keep_order(setting_, state_);
    refresh_neighbours(setting_, state_, work_);
  });
  timed(times.coefficients,
        [&] { compute_coefficients(setting_, state_, work_, StepMoment::first); });
  timed(times.viscosity, [&] {
    predict(setting_, state_, work_, dt);
    move(state_.particles, dt);
  });
  timed(times.neighbours, [&] { refresh_neighbours(setting_, state_, work_); });
  timed(times.coefficients,
        [&] { compute_coefficients(setting_, state_, work_, StepMoment::moved); });
  timed(times.pressure, [&] {
    pressure_source(setting_, state_, work_, dt);
    project(setting_, state_, work_, dt);
  });
  if (setting_.options.shift != ShiftKind::none) {
    timed(times.neighbours, [&] { refresh_neighbours(setting_, state_, work_); });
    timed(times.shifting, [&] { shift_particles(setting_, state_, work_); });
  }
  timed(times.other, [&] {
    state_.time += dt;
    ++state_.step;
    watch(setting_, state_, work_, limits_);
    if (pass_openings(setting_.openings, state_.particles, state_.depths, state_.ledger)) {
      state_.table_positions.clear();
    }
  });
}

template <int dim>
Snapshot SemiImplicitStepper<dim>::snapshot() const {
  return to_snapshot(state_);
}

template <int dim>
void SemiImplicitStepper<dim>::restore(const Snapshot& snapshot) {
  state_ = from_snapshot<dim>(snapshot);
  resume();
}

template <int dim>
void SemiImplicitStepper<dim>::resume() {
  // Without the places of the last search, the next step searches anyway.
  if (state_.table_positions.empty()) return;
  rebuild_neighbours(setting_, state_, work_);
}

template class SemiImplicitStepper<2>;
template class SemiImplicitStepper<3>;

}  // namespace hemoscale::micro
