#include "micro/mps/projection_solver.hpp"

#include <algorithm>

#include "micro/mps/block_pattern.hpp"

namespace hemoscale::micro {

namespace {

void worst_of(SolveReport& report, const SolveReport& one) {
  report.iterations = std::max(report.iterations, one.iterations);
  report.relative_residual = std::max(report.relative_residual, one.relative_residual);
}

}  // namespace

template <int dim>
ProjectionSolver<dim>::ProjectionSolver(const Fluid& fluid, PressureCoupling coupling,
                                        ViscosityTreatment viscosity, const StageSolving& solving,
                                        const Communicator& ranks)
    : fluid_(fluid), coupling_(coupling), viscosity_(viscosity), solving_(solving), ranks_(ranks) {}

template <int dim>
void ProjectionSolver<dim>::prepare(const NodeGeometry<dim>& nodes, double rate) {
  rate_ = rate;
  const auto pattern = block_pattern(nodes.table, 1, nodes.stencils.rows(nodes.size()));
  momentum_ = SparseMatrix(pattern);
  pressure_ = SparseMatrix(pattern);
  assemble(nodes);
  SystemTraits traits;
  if (has_free_pressure_level(nodes.kinds)) traits.null_space = ConstantNullSpace{};
  pressure_solver_ = make_node_solver(nodes, *pattern, traits, solving_, ranks_);
  pressure_solver_->prepare(pressure_);
  if (viscosity_ == ViscosityTreatment::implicit) {
    momentum_solver_ = make_node_solver(nodes, *pattern, SystemTraits{}, solving_, ranks_);
    momentum_solver_->prepare(momentum_);
  }
}

// Momentum is divided by a0 and pressure multiplied by l0^2, so that entries are of order one.

template <int dim>
void ProjectionSolver<dim>::assemble(const NodeGeometry<dim>& nodes) {
  const double l = nodes.spacing;
  const double diffusion = fluid_.kinematic_viscosity / rate_;  // [m^2]
  const NeighbourTable& table = nodes.table;
  const NodeRange own = nodes.stencils.rows(nodes.size());
#pragma omp parallel for schedule(static)
  for (std::size_t i = own.begin; i < own.end; ++i) {
    BlockRow momentum(momentum_, table, 1, i);
    BlockRow pressure(pressure_, table, 1, i);
    const ParticleKind kind = nodes.kinds[i];
    if (kind != ParticleKind::outlet) momentum.add_own(0, 0, 1);
    if (has_given_pressure(kind)) pressure.add_own(0, 0, 1);
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      const double along_normal = l * nodes.normals[i].dot(nodes.stencils.gradient[k]);
      const double laplacian = nodes.stencils.laplacian[k];
      if (has_momentum(kind)) momentum.add_difference(0, k, 0, -diffusion * laplacian);
      if (kind == ParticleKind::outlet) momentum.add_difference(0, k, 0, along_normal);
      if (kind == ParticleKind::fluid) pressure.add_difference(0, k, 0, l * l * laplacian);
      if (has_given_velocity(kind)) pressure.add_difference(0, k, 0, along_normal);
    }
  }
}

template <int dim>
void ProjectionSolver<dim>::predict(const NodeGeometry<dim>& nodes,
                                    const StageProblem<dim>& problem,
                                    const std::vector<double>& pressures,
                                    std::vector<Vector<dim>>& velocities, SolveReport& report) {
  const std::size_t count = nodes.size();
  std::vector<Vector<dim>> target(count);
  std::vector<Vector<dim>> gradient(count, Vector<dim>::Zero());
  std::vector<Vector<dim>> friction(count, Vector<dim>::Zero());
  if (coupling_ == PressureCoupling::incremental) {
    apply_gradient(nodes.stencils, nodes.table, pressures, gradient);
  }
  if (viscosity_ == ViscosityTreatment::explicit_euler) {
    apply_laplacian(nodes.stencils, nodes.table, velocities, friction);
  }
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    if (has_momentum(nodes.kinds[i])) {
      target[i] = (problem.source[i] - gradient[i] / fluid_.density +
                   fluid_.kinematic_viscosity * friction[i]) /
                  rate_;
    } else if (has_given_velocity(nodes.kinds[i])) {
      target[i] = problem.velocity[i];
    } else {
      target[i] = Vector<dim>::Zero();  // no change along the normal of an outlet
    }
  }
  if (viscosity_ == ViscosityTreatment::explicit_euler) {
    for (std::size_t i = 0; i < count; ++i) {
      if (nodes.kinds[i] != ParticleKind::outlet) velocities[i] = target[i];
    }
    return;
  }
  std::vector<double> right(count);
  std::vector<double> solution(count);
  for (int c = 0; c < dim; ++c) {
    for (std::size_t i = 0; i < count; ++i) {
      right[i] = target[i][c];
      solution[i] = velocities[i][c];
    }
    worst_of(report, momentum_solver_->solve(right, solution));
    for (std::size_t i = 0; i < count; ++i) velocities[i][c] = solution[i];
  }
}

template <int dim>
SolveReport ProjectionSolver<dim>::solve(const NodeGeometry<dim>& nodes,
                                         const StageProblem<dim>& problem,
                                         std::vector<Vector<dim>>& velocities,
                                         std::vector<double>& pressures) {
  SolveReport report;
  predict(nodes, problem, pressures, velocities, report);

  const std::size_t count = nodes.size();
  const double l = nodes.spacing;
  const bool is_incremental = coupling_ == PressureCoupling::incremental;
  std::vector<double> divergence;
  std::vector<double> wide_laplacian(count, 0.0);  // D G p_before [Pa/m^2]
  std::vector<Vector<dim>> gradient(count, Vector<dim>::Zero());
  apply_divergence(nodes.stencils, nodes.table, velocities, divergence);
  if (is_incremental) {
    apply_gradient(nodes.stencils, nodes.table, pressures, gradient);
    apply_divergence(nodes.stencils, nodes.table, gradient, wide_laplacian);
  }
  std::vector<double> right(count);
  std::vector<double> solution = pressures;
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    const ParticleKind kind = nodes.kinds[i];
    if (has_given_pressure(kind)) {
      right[i] = problem.pressure[i];
    } else if (has_given_velocity(kind)) {
      right[i] = l * fluid_.density * nodes.normals[i].dot(problem.source[i]);
    } else {
      right[i] = l * l * (fluid_.density * rate_ * divergence[i] + wide_laplacian[i]);
    }
  }
  worst_of(report, pressure_solver_->solve(right, solution));

  std::vector<double> increment(count);
  for (std::size_t i = 0; i < count; ++i) {
    increment[i] = is_incremental ? solution[i] - pressures[i] : solution[i];
  }
  apply_gradient(nodes.stencils, nodes.table, increment, gradient);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    if (!has_given_velocity(nodes.kinds[i])) {
      velocities[i] -= gradient[i] / (fluid_.density * rate_);
    }
  }
  pressures = solution;
  return report;
}

template <int dim>
std::string ProjectionSolver<dim>::describe() const {
  std::string text =
      pressure_solver_ ? "pressure: " + pressure_solver_->describe() : "not prepared";
  if (momentum_solver_) text += "; velocity: " + momentum_solver_->describe();
  return text;
}

template class ProjectionSolver<2>;
template class ProjectionSolver<3>;

}  // namespace hemoscale::micro
