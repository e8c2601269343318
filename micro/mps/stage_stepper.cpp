#include "micro/mps/stage_stepper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "micro/error.hpp"
#include "micro/mps/node_checks.hpp"
#include "micro/mps/node_exchange.hpp"
#include "micro/mps/node_shifting.hpp"
#include "micro/mps/stage_limits.hpp"

namespace hemoscale::micro {

namespace {

template <typename Solver>
std::string description_of(const std::unique_ptr<Solver>& solver) {
  return solver ? solver->describe() : "not prepared";
}

/// a x + y
template <int dim>
std::vector<Vector<dim>> moved(const std::vector<Vector<dim>>& y, double a,
                               const std::vector<Vector<dim>>& x) {
  std::vector<Vector<dim>> sum(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) sum[i] = y[i] + a * x[i];
  return sum;
}

}  // namespace

template <int dim>
StageStepper<dim>::StageStepper(FlowDomain<dim> domain, const Fluid& fluid,
                                const StageOptions& options,
                                std::shared_ptr<const Communicator> ranks)
    : domain_(std::move(domain)), fluid_(fluid), options_(options), ranks_(std::move(ranks)) {
  check(options_);
  check_fluid(fluid_, options_.inertia == Inertia::quasi_steady);
  const StageSolving solving{.kind = options_.linear_solver,
                             .tolerance = options_.tolerance,
                             .is_reused = options_.motion == NodeMotion::eulerian};
  if (options_.coupling == PressureCoupling::coupled) {
    solver_ =
        std::make_unique<CoupledSolver<dim>>(fluid_, options_.stabilisation, solving, *ranks_);
  } else {
    solver_ = std::make_unique<ProjectionSolver<dim>>(fluid_, options_.coupling, options_.viscosity,
                                                      solving, *ranks_);
  }
  for (const std::int64_t identity : domain_.particles.identities) {
    next_identity_ = std::max(next_identity_, identity + 1);
  }
}

template <int dim>
void StageStepper<dim>::step(double time_step) {
  if (!(time_step > 0)) {
    throw ParameterError(fmt::format("the time step is {:g} s; it must be positive", time_step));
  }
  const ParticleSet<dim> before = domain_.particles;
  const double time_before = time_;
  try {
    advance(time_step);
  } catch (const NumericalError& error) {
    domain_.particles = before;
    time_ = time_before;
    nodes_are_current_ = false;
    std::string causes;
    std::vector<Limit> limits = stage_limits<dim>(options_, fluid_, domain_.spacing, time_step, {});
    if (domain_.local_limits) {
      for (const Limit& limit : domain_.local_limits(time_step)) limits.push_back(limit);
    }
    for (const Limit& limit : limits) {
      if (limit.exceeded()) causes += "; " + describe(limit);
    }
    throw NumericalError(fmt::format("step {}, time {:.6g} s: {}{}", steps_ + 1, time_ + time_step,
                                     error.what(), causes));
  }
  ++steps_;
}

template <int dim>
void StageStepper<dim>::advance(double time_step) {
  ParticleSet<dim>& particles = domain_.particles;
  report_.solve = {};
  report_.stages = 0;
  report_.smallest_distance = 0;
  // In a sheared box the velocity relative to the shear is periodic, and is what is solved for.
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles.velocities[i] -= sliding_velocity(particles.positions[i]);
  }
  if (options_.inertia == Inertia::quasi_steady) {
    solve_quasi_steady(time_step);
  } else {
    solve_unsteady(time_step);
  }
  time_ += time_step;
  if (options_.motion != NodeMotion::eulerian) {
    particles.positions = nodes_.positions;
    check_nodes(nodes_, report_.smallest_distance);
    if (options_.motion == NodeMotion::lagrangian && options_.shifting != Shifting::none) {
      move_nodes_apart();
    }
    exchange_at_openings();
    for (Vector<dim>& x : particles.positions) x = wrapped(domain_.box, x);
    // Images are the same nodes.
    if (nodes_are_current_) nodes_.positions = particles.positions;
  }
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles.velocities[i] += sliding_velocity(particles.positions[i]);
  }
  // Without inertia nothing is carried past resting nodes, however far the fluid goes in a step.
  const bool is_carried =
      options_.motion != NodeMotion::eulerian || options_.inertia == Inertia::unsteady;
  report_.largest_speed = check_speeds(particles, domain_.spacing, is_carried ? time_step : 0);
}

template <int dim>
void StageStepper<dim>::settle() {
  if (options_.inertia != Inertia::quasi_steady || options_.motion != NodeMotion::eulerian) {
    throw ParameterError(
        "only quasi-steady flow on resting nodes can settle while no time passes; choose these, or "
        "take steps");
  }
  if (domain_.sliding_rate != 0) {
    throw ParameterError("flow in a sheared box cannot settle while no time passes; take a step");
  }
  report_.solve = {};
  report_.stages = 0;
  solve_quasi_steady(0);
  report_.largest_speed = check_speeds(domain_.particles, domain_.spacing, 0);
}

template <int dim>
void StageStepper<dim>::solve_unsteady(double time_step) {
  ParticleSet<dim>& particles = domain_.particles;
  const std::vector<Vector<dim>> start = particles.positions;
  const std::vector<Vector<dim>> u0 = particles.velocities;
  rebuild(start, time_);
  const std::vector<Vector<dim>> w0 = node_velocities(u0, time_step);
  const std::vector<Vector<dim>> n0 = explicit_part(u0, w0);

  const bool is_euler = options_.time_scheme == TimeScheme::euler;
  const double g = is_euler ? 1 : 1 - 1 / std::sqrt(2.0);
  const double rate = 1 / (g * time_step);

  // First stage, the only one of Euler.
  const double first_time = time_ + g * time_step;
  carry_pressure(moved<dim>(start, g * time_step, w0));
  rebuild(moved<dim>(start, g * time_step, w0), first_time);
  prepare(rate);
  StageProblem<dim> problem = boundary_values(first_time);
  const Vector<dim> first_force = body_acceleration(domain_, first_time);
  for (std::size_t i = 0; i < u0.size(); ++i) {
    if (has_momentum(particles.kinds[i])) {
      problem.source[i] = rate * u0[i] + n0[i] + first_force;
    } else {
      problem.source[i] += n0[i];
    }
  }
  add_local_acceleration(first_time, problem.source);
  remember(solve_stage(problem, particles.velocities, particles.pressures));
  if (is_euler) return;

  // Second stage.
  const std::vector<Vector<dim>> u1 = particles.velocities;
  const std::vector<Vector<dim>> w1 = node_velocities(u1, time_step);
  const std::vector<Vector<dim>> n1 = explicit_part(u1, w1);
  const double d = 1 - 1 / (2 * g);
  const double last_time = time_ + time_step;
  const std::vector<Vector<dim>> end =
      moved<dim>(moved<dim>(start, d * time_step, w0), (1 - d) * time_step, w1);
  carry_pressure(end);
  rebuild(end, last_time);
  prepare(rate);
  problem = boundary_values(last_time);
  const Vector<dim> last_force = body_acceleration(domain_, last_time);
  for (std::size_t i = 0; i < u0.size(); ++i) {
    if (has_momentum(particles.kinds[i])) {
      const Vector<dim> implicit_part = rate * (u1[i] - u0[i]) - n0[i];
      problem.source[i] = rate * u0[i] + (d * n0[i] + (1 - d) * n1[i]) / g +
                          (1 - g) / g * implicit_part + last_force;
    } else {
      problem.source[i] += n1[i];
    }
  }
  add_local_acceleration(last_time, problem.source);
  remember(solve_stage(problem, particles.velocities, particles.pressures));
}

template <int dim>
void StageStepper<dim>::solve_quasi_steady(double time_step) {
  ParticleSet<dim>& particles = domain_.particles;
  const double end = time_ + time_step;
  if (options_.motion != NodeMotion::eulerian) {
    // The midpoint rule: velocities of the half step carry the nodes.
    rebuild(particles.positions, time_);
    const std::vector<Vector<dim>> start = particles.positions;
    const auto w0 = node_velocities(particles.velocities, time_step);
    carry_pressure(moved<dim>(start, time_step / 2, w0));
    rebuild(moved<dim>(start, time_step / 2, w0), time_ + time_step / 2);
    prepare(0);
    StageProblem<dim> half = boundary_values(time_ + time_step / 2);
    const Vector<dim> force = body_acceleration(domain_, time_ + time_step / 2);
    for (std::size_t i = 0; i < half.source.size(); ++i) {
      if (has_momentum(particles.kinds[i])) half.source[i] = force;
    }
    add_local_acceleration(time_ + time_step / 2, half.source);
    remember(solve_stage(half, particles.velocities, particles.pressures));
    const auto w1 = node_velocities(particles.velocities, time_step);
    carry_pressure(moved<dim>(start, time_step, w1));
    rebuild(moved<dim>(start, time_step, w1), end);
  } else {
    rebuild(particles.positions, end);
  }
  prepare(0);
  StageProblem<dim> problem = boundary_values(end);
  const Vector<dim> force = body_acceleration(domain_, end);
  for (std::size_t i = 0; i < problem.source.size(); ++i) {
    if (has_momentum(particles.kinds[i])) problem.source[i] = force;
  }
  add_local_acceleration(end, problem.source);
  // The stabilisation takes the pressure of the solution before: repeated until it is its own.
  constexpr int largest_count = 30;
  constexpr double wanted = 1e-12;
  for (int count = 0; count < largest_count; ++count) {
    const std::vector<Vector<dim>> last = particles.velocities;
    remember(solve_stage(problem, particles.velocities, particles.pressures));
    double change = 0;
    double speed = 0;
    for (std::size_t i = 0; i < last.size(); ++i) {
      change = std::max(change, (particles.velocities[i] - last[i]).norm());
      speed = std::max(speed, particles.velocities[i].norm());
    }
    if (!(change > wanted * speed)) return;
  }
}

template <int dim>
std::vector<Vector<dim>> StageStepper<dim>::node_velocities(
    const std::vector<Vector<dim>>& velocities, double time_step) const {
  std::vector<Vector<dim>> result(velocities.size(), Vector<dim>::Zero());
  if (options_.motion == NodeMotion::eulerian) return result;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    if (!has_momentum(domain_.particles.kinds[i])) continue;
    result[i] = velocities[i];
    if (domain_.sliding_rate != 0) result[i] += sliding_velocity(nodes_.positions[i]);
  }
  if (options_.motion == NodeMotion::ale && options_.shifting != Shifting::none) {
    const auto shifts =
        shifting_displacements(nodes_, options_.shifting_strength * domain_.spacing);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += shifts[i] / time_step;
  }
  return result;
}

template <int dim>
std::vector<Vector<dim>> StageStepper<dim>::explicit_part(
    const std::vector<Vector<dim>>& velocities,
    const std::vector<Vector<dim>>& node_velocities) const {
  const std::size_t count = velocities.size();
  std::vector<Vector<dim>> result(count, Vector<dim>::Zero());
  const bool needs_gradient =
      options_.motion != NodeMotion::lagrangian || has_openings(domain_.particles);
  const double shear = domain_.sliding_rate;
  if (!needs_gradient && shear == 0) return result;
  const NodeRange own = nodes_.stencils.rows(count);
#pragma omp parallel for schedule(static)
  for (std::size_t i = own.begin; i < own.end; ++i) {
    // At boundaries the acceleration of the fluid passing by counts, for the normal pressure.
    const Vector<dim> node_velocity = has_momentum(domain_.particles.kinds[i])
                                          ? node_velocities[i]
                                          : Vector<dim>(Vector<dim>::Zero());
    Vector<dim> relative = velocities[i] - node_velocity;
    if (shear != 0) relative += sliding_velocity(nodes_.positions[i]);
    if (needs_gradient && !relative.isZero(0)) {
      result[i] = -velocity_gradient(nodes_.stencils, nodes_.table, velocities, i) * relative;
    }
    if (shear != 0) result[i][0] -= shear * velocities[i][1];
  }
  gather_rows(nodes_.stencils, result);
  return result;
}

template <int dim>
StageProblem<dim> StageStepper<dim>::boundary_values(double time) const {
  const ParticleSet<dim>& particles = domain_.particles;
  StageProblem<dim> problem;
  problem.source.assign(particles.size(), Vector<dim>::Zero());
  problem.velocity.assign(particles.size(), Vector<dim>::Zero());
  problem.pressure.assign(particles.size(), 0.0);
  const Vector<dim> force = body_acceleration(domain_, time);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.patches[i] < 0) continue;
    const Patch<dim>& patch = domain_.patches[static_cast<std::size_t>(particles.patches[i])];
    if (has_given_velocity(particles.kinds[i])) {
      problem.velocity[i] = patch_velocity(patch, particles.positions[i], time);
      problem.source[i] = force - boundary_acceleration(i, time);
    } else if (patch.pressure) {
      problem.pressure[i] = patch.pressure(time);
    }
  }
  return problem;
}

template <int dim>
void StageStepper<dim>::add_local_acceleration(double time,
                                               std::vector<Vector<dim>>& source) const {
  if (!domain_.local_acceleration) return;
  if (options_.motion == NodeMotion::eulerian && domain_.sliding_rate == 0) {
    domain_.local_acceleration(domain_.particles, time, source);
    return;
  }
  // Nodes on their way, and velocities without the shear, are an affair of the stepper alone.
  ParticleSet<dim> particles = domain_.particles;
  particles.positions = nodes_.positions;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles.velocities[i] += sliding_velocity(particles.positions[i]);
  }
  domain_.local_acceleration(particles, time, source);
}

template <int dim>
Vector<dim> StageStepper<dim>::boundary_acceleration(std::size_t node, double time) const {
  const ParticleSet<dim>& particles = domain_.particles;
  const Patch<dim>& patch = domain_.patches[static_cast<std::size_t>(particles.patches[node])];
  if (!patch.velocity) return Vector<dim>::Zero();
  // A central difference over a thousandth of the viscous time of a spacing: shorter than anything
  // the flow can follow, longer than rounding of the time. Without viscosity walls do not
  // accelerate the fluid along them, and the normal part is that of a wall at rest.
  if (!(fluid_.kinematic_viscosity > 0)) return Vector<dim>::Zero();
  const double half = 0.0005 * domain_.spacing * domain_.spacing / fluid_.kinematic_viscosity;
  const Vector<dim>& x = particles.positions[node];
  return (patch.velocity(x, time + half) - patch.velocity(x, time - half)) / (2 * half);
}

template <int dim>
Vector<dim> StageStepper<dim>::sliding_velocity(const Vector<dim>& x) const {
  Vector<dim> u = Vector<dim>::Zero();
  u[0] = domain_.sliding_rate * (x[1] - domain_.box.lower[1]);
  return u;
}

template <int dim>
void StageStepper<dim>::rebuild(const std::vector<Vector<dim>>& positions, double time) {
  if (nodes_are_current_ && positions == nodes_.positions) return;
  if (domain_.sliding_rate != 0) {
    const Vector<dim> extent = domain_.box.extent();
    domain_.box.slide = std::fmod(domain_.sliding_rate * extent[1] * time, extent[0]);
  }
  nodes_.spacing = domain_.spacing;
  nodes_.positions = positions;
  nodes_.box = domain_.box;
  nodes_.kinds = domain_.particles.kinds;
  nodes_.normals = domain_.particles.normals;
  const double radius = options_.kernel_ratio * domain_.spacing;
  nodes_.table.template build<dim>(nodes_.positions, nodes_.box, radius);
  nodes_.stencils = least_squares_stencils<dim>(
      {.radius = radius, .condition_bound = options_.condition_bound}, nodes_.positions, nodes_.box,
      nodes_.table, &report_.fit, ranks_.get());
  nodes_are_current_ = true;
  prepared_rate_ = -1;
}

template <int dim>
void StageStepper<dim>::carry_pressure(const std::vector<Vector<dim>>& places) {
  if (options_.motion == NodeMotion::eulerian) return;
  // The pressure is a field at a place, not a property of the fluid that moves.
  std::vector<Vector<dim>> gradient;
  apply_gradient(nodes_.stencils, nodes_.table, domain_.particles.pressures, gradient);
  for (std::size_t i = 0; i < places.size(); ++i) {
    domain_.particles.pressures[i] += gradient[i].dot(places[i] - nodes_.positions[i]);
  }
}

template <int dim>
void StageStepper<dim>::prepare(double rate) {
  if (prepared_rate_ == rate) return;
  std::visit([&](const auto& solver) { solver->prepare(nodes_, rate); }, solver_);
  prepared_rate_ = rate;
}

template <int dim>
SolveReport StageStepper<dim>::solve_stage(const StageProblem<dim>& problem,
                                           std::vector<Vector<dim>>& velocities,
                                           std::vector<double>& pressures) {
  return std::visit(
      [&](const auto& solver) { return solver->solve(nodes_, problem, velocities, pressures); },
      solver_);
}

template <int dim>
void StageStepper<dim>::move_nodes_apart() {
  ParticleSet<dim>& particles = domain_.particles;
  const auto shifts = shifting_displacements(nodes_, options_.shifting_strength * domain_.spacing);
  const LeastSquares fit{.radius = options_.kernel_ratio * domain_.spacing,
                         .condition_bound = options_.condition_bound};
  // Carried values follow to second order: a first-order shift would spoil the second-order
  // operators.
  const std::vector<Vector<dim>> u = particles.velocities;
  const std::vector<double> p = particles.pressures;
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vector<dim>& shift = shifts[i];
    if (shift.isZero(0)) continue;
    const FlowDerivatives<dim> d =
        flow_derivatives<dim>(fit, nodes_.positions, nodes_.box, nodes_.table, u, p, i);
    const auto change = [&](const Derivatives<dim>& f) {
      return f.gradient.dot(shift) + shift.dot(f.hessian * shift) / 2;
    };
    for (int c = 0; c < dim; ++c)
      particles.velocities[i][c] += change(d.velocity[static_cast<std::size_t>(c)]);
    particles.pressures[i] += change(d.pressure);
    particles.positions[i] += shift;
  }
  nodes_are_current_ = false;
}

template <int dim>
void StageStepper<dim>::exchange_at_openings() {
  if (!has_openings(domain_.particles)) return;
  const LeastSquares fit{.radius = options_.kernel_ratio * domain_.spacing,
                         .condition_bound = options_.condition_bound};
  const ExchangeCount count = exchange_nodes(domain_, fit, next_identity_);
  report_.inserted += count.inserted;
  report_.removed += count.removed;
  if (count.inserted + count.removed > 0) nodes_are_current_ = false;
}

template <int dim>
const NodeGeometry<dim>& StageStepper<dim>::nodes() {
  if (!nodes_are_current_) rebuild(domain_.particles.positions, time_);
  return nodes_;
}

template <int dim>
void StageStepper<dim>::remember(const SolveReport& report) {
  ++report_.stages;
  report_.solve.iterations = std::max(report_.solve.iterations, report.iterations);
  report_.solve.relative_residual =
      std::max(report_.solve.relative_residual, report.relative_residual);
}

template <int dim>
void StageStepper<dim>::restore(ParticleSet<dim> particles, const StageCounters& counters) {
  domain_.particles = std::move(particles);
  time_ = counters.time;
  steps_ = counters.steps;
  next_identity_ = counters.next_identity;
  report_.inserted = counters.inserted;
  report_.removed = counters.removed;
  nodes_are_current_ = false;
}

template <int dim>
std::string StageStepper<dim>::describe_solver() const {
  return std::visit([](const auto& solver) { return description_of(solver); }, solver_);
}

template class StageStepper<2>;
template class StageStepper<3>;

}  // namespace hemoscale::micro
