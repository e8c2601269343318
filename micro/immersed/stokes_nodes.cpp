#include "micro/immersed/stokes_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "micro/error.hpp"
#include "micro/mps/least_squares.hpp"

namespace hemoscale::micro {

namespace {

StageProblem<2> empty_problem(std::size_t count) {
  StageProblem<2> problem;
  problem.source.assign(count, Vector<2>::Zero());
  problem.velocity.assign(count, Vector<2>::Zero());
  problem.pressure.assign(count, 0.0);
  problem.outflow_rate.assign(count, 0.0);
  return problem;
}

void require_resting_stokes(const StageOptions& options) {
  if (options.coupling != PressureCoupling::coupled || options.motion != NodeMotion::eulerian ||
      options.inertia != Inertia::quasi_steady) {
    throw ParameterError(
        "the implicit membrane needs plasma in quasi-steady flow on resting nodes, velocity and "
        "pressure together; choose coupling coupled, motion eulerian, inertia quasi-steady, or an "
        "explicit membrane");
  }
}

}  // namespace

StokesNodes::StokesNodes(FlowDomain<2> domain, const Fluid& fluid, const StageOptions& options)
    : domain_(std::move(domain)), fluid_(fluid), alone_(std::make_unique<Communicator>()) {
  check(options);
  require_resting_stokes(options);
  if (!(fluid_.viscosity() > 0) || !std::isfinite(fluid_.viscosity())) {
    throw ParameterError(fmt::format(
        "the viscosity is {:g} Pa s; it must be positive and finite for flow without inertia",
        fluid_.viscosity()));
  }
  const double radius = options.kernel_ratio * domain_.spacing;
  nodes_.spacing = domain_.spacing;
  nodes_.positions = domain_.particles.positions;
  nodes_.box = domain_.box;
  nodes_.kinds = domain_.particles.kinds;
  nodes_.normals = domain_.particles.normals;
  nodes_.table.build<2>(nodes_.positions, nodes_.box, radius);
  nodes_.stencils =
      least_squares_stencils<2>({.radius = radius, .condition_bound = options.condition_bound},
                                nodes_.positions, nodes_.box, nodes_.table);
  solver_ = std::make_unique<CoupledSolver<2>>(
      fluid_, options.stabilisation,
      StageSolving{
          .kind = options.linear_solver, .tolerance = options.tolerance, .is_reused = true},
      *alone_);
  solver_->prepare(nodes_, 0);
  sampler_ = std::make_unique<NodeSampler<2>>(nodes_.positions, nodes_.box, radius);
  outlet_offset_ = 0.01 * domain_.spacing;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (has_given_velocity(nodes_.kinds[i]) || nodes_.kinds[i] == ParticleKind::outlet) {
      bounding_.push_back(i);
      places_.push_back(nodes_.positions[i]);
    }
  }
  for (const std::size_t i : bounding_) {
    if (nodes_.kinds[i] != ParticleKind::outlet) continue;
    places_.push_back(nodes_.positions[i] - outlet_offset_ * nodes_.normals[i]);
    places_.push_back(nodes_.positions[i] + outlet_offset_ * nodes_.normals[i]);
  }
}

FlowValues StokesNodes::background(double t) const {
  const std::size_t count = nodes_.size();
  StageProblem<2> problem = empty_problem(count);
  const Vector<2> force = body_acceleration(domain_, t);
  for (std::size_t i = 0; i < count; ++i) {
    problem.source[i] = force;
    const std::int32_t patch = domain_.particles.patches[i];
    if (patch < 0) continue;
    const Patch<2>& p = domain_.patches[static_cast<std::size_t>(patch)];
    if (has_given_velocity(nodes_.kinds[i])) {
      problem.velocity[i] = patch_velocity(p, nodes_.positions[i], t);
    } else if (p.pressure) {
      problem.pressure[i] = p.pressure(t);
    }
  }
  FlowValues flow{std::vector<Vector<2>>(count, Vector<2>::Zero()),
                  std::vector<double>(count, 0.0)};
  // The stabilisation refers to the pressure before and vanishes as both agree.
  constexpr int most_solves = 8;
  constexpr double wanted = 1e-6;  // [-] change of the velocity over the largest
  for (int solve = 0; solve < most_solves; ++solve) {
    const std::vector<Vector<2>> last = flow.velocities;
    solver_->solve(nodes_, problem, flow.velocities, flow.pressures);
    double change = 0;
    double speed = 0;
    for (std::size_t i = 0; i < count; ++i) {
      change = std::max(change, (flow.velocities[i] - last[i]).norm());
      speed = std::max(speed, flow.velocities[i].norm());
    }
    if (!(change > wanted * speed)) break;
  }
  return flow;
}

FlowValues StokesNodes::reaction(const FlowAt& disturbance) const {
  const std::size_t count = nodes_.size();
  const FlowValues imposed = disturbance(places_);
  StageProblem<2> problem = empty_problem(count);
  std::size_t beside = bounding_.size();
  for (std::size_t k = 0; k < bounding_.size(); ++k) {
    const std::size_t i = bounding_[k];
    problem.velocity[i] = -imposed.velocities[k];
    if (nodes_.kinds[i] != ParticleKind::outlet) continue;
    problem.pressure[i] = -imposed.pressures[k];
    const Vector<2> change = imposed.velocities[beside + 1] - imposed.velocities[beside];
    problem.outflow_rate[i] = -nodes_.normals[i].dot(change) / (2 * outlet_offset_);
    beside += 2;
  }
  FlowValues flow{std::vector<Vector<2>>(count, Vector<2>::Zero()),
                  std::vector<double>(count, 0.0)};
  // The pressure of Stokes flow is harmonic: the stabilisation needs no pressure before.
  solver_->solve(nodes_, problem, flow.velocities, flow.pressures);
  return flow;
}

}  // namespace hemoscale::micro
