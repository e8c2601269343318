#include "micro/mps/saddle_point_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "micro/linear/aggregate_solver.hpp"
#include "micro/linear/flexible_gmres.hpp"
#include "micro/mps/block_pattern.hpp"
#include "micro/mps/node_solver.hpp"

namespace hemoscale::micro {

namespace {

/// Residual to which the scalar systems of the sweep are solved: more would not help the outer
/// iteration, less costs it steps.
constexpr SolveTolerance loose{.relative_residual = 1e-3, .maximum_iterations = 200};

/// The momentum of one component, and the Laplacian of the pressure with its boundary rows.
template <int dim>
void assemble_parts(const NodeGeometry<dim>& nodes, const SaddlePointCoefficients& coefficients,
                    SparseMatrix& velocity, SparseMatrix& pressure) {
  const double l = nodes.spacing;
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    BlockRow momentum(velocity, nodes.table, 1, i);
    BlockRow laplace(pressure, nodes.table, 1, i);
    const ParticleKind kind = nodes.kinds[i];
    if (has_momentum(kind)) momentum.add_own(0, 0, coefficients.inertia);
    if (has_given_velocity(kind)) momentum.add_own(0, 0, 1);
    if (has_given_pressure(kind)) laplace.add_own(0, 0, 1);
    for (std::size_t k = nodes.table.begin(i); k < nodes.table.end(i); ++k) {
      const double laplacian = nodes.stencils.laplacian[k];
      const double along_normal = l * nodes.normals[i].dot(nodes.stencils.gradient[k]);
      if (has_momentum(kind)) momentum.add_difference(0, k, 0, -coefficients.viscous * laplacian);
      if (kind == ParticleKind::outlet) momentum.add_difference(0, k, 0, along_normal);
      if (kind == ParticleKind::fluid) laplace.add_difference(0, k, 0, l * l * laplacian);
      if (has_given_velocity(kind)) laplace.add_difference(0, k, 0, along_normal);
    }
  }
}

}  // namespace

template <int dim>
SaddlePointSolver<dim>::SaddlePointSolver(const NodeGeometry<dim>& nodes,
                                          const SaddlePointCoefficients& coefficients,
                                          const SolveTolerance& tolerance,
                                          std::optional<ConstantNullSpace> null_space)
    : kinds_(nodes.kinds),
      coefficients_(coefficients),
      spacing_(nodes.spacing),
      tolerance_(tolerance),
      null_space_(null_space) {
  const auto pattern = block_pattern(nodes.table, 1, {0, nodes.size()});
  SparseMatrix velocity(pattern);
  SparseMatrix pressure(pattern);
  assemble_parts(nodes, coefficients_, velocity, pressure);
  std::optional<ConstantNullSpace> constant;
  if (null_space_) constant = ConstantNullSpace{};
  const NodeLayout<dim> layout = node_layout(nodes);
  velocity_ = std::make_unique<AggregateSolver<dim>>(layout, false, loose);
  pressure_ = std::make_unique<AggregateSolver<dim>>(layout, false, loose, constant);
  velocity_->prepare(velocity);
  pressure_->prepare(pressure);
}

template <int dim>
void SaddlePointSolver<dim>::prepare(const SparseMatrix& matrix) {
  matrix_ = matrix;
  product_.resize(matrix.rows());
  right_.resize(kinds_.size());
  solution_.resize(kinds_.size());
}

template <int dim>
void SaddlePointSolver<dim>::solve_velocities(std::span<const double> right,
                                              std::span<double> step) {
  constexpr std::size_t block = dim + 1;
  for (std::size_t c = 0; c < dim; ++c) {
    for (std::size_t i = 0; i < kinds_.size(); ++i) right_[i] = right[block * i + c];
    std::fill(solution_.begin(), solution_.end(), 0.0);
    velocity_->solve(right_, solution_);
    for (std::size_t i = 0; i < kinds_.size(); ++i) step[block * i + c] = solution_[i];
  }
}

template <int dim>
void SaddlePointSolver<dim>::precondition(std::span<const double> residual,
                                          std::span<double> step) {
  constexpr std::size_t block = dim + 1;
  const std::size_t count = kinds_.size();
  std::fill(step.begin(), step.end(), 0.0);
  solve_velocities(residual, step);

  // What the velocities leave of continuity and of the pressure's boundary rows.
  multiply(matrix_, step, product_);
  const double squared = spacing_ * spacing_;
  const double weight = coefficients_.inertia > 0
                            ? 1 / (1 / coefficients_.inertia + coefficients_.smoothing / squared)
                            : 0;
  std::vector<double> left(count);
  for (std::size_t i = 0; i < count; ++i) {
    left[i] = residual[block * i + dim] - product_[block * i + dim];
    right_[i] = kinds_[i] == ParticleKind::fluid ? -weight * left[i] : left[i];
  }
  std::fill(solution_.begin(), solution_.end(), 0.0);
  pressure_->solve(right_, solution_);
  for (std::size_t i = 0; i < count; ++i) {
    step[block * i + dim] = solution_[i];
    if (kinds_[i] == ParticleKind::fluid) {
      step[block * i + dim] += coefficients_.viscous / squared * left[i];
    }
    for (std::size_t c = 0; c < dim; ++c) step[block * i + c] = 0;
  }

  // Velocities that go with this pressure.
  multiply(matrix_, step, product_);
  std::vector<double> momentum(residual.begin(), residual.end());
  for (std::size_t i = 0; i < momentum.size(); ++i) momentum[i] -= product_[i];
  solve_velocities(momentum, step);
}

template <int dim>
SolveReport SaddlePointSolver<dim>::solve(std::span<const double> b, std::span<double> x) {
  std::vector<double> right(b.begin(), b.end());
  if (null_space_) remove_mean(*null_space_, right);
  const auto apply = [&](std::span<const double> in, std::span<double> out) {
    multiply(matrix_, in, out);
    if (null_space_) remove_mean(*null_space_, out);
  };
  const double size = std::sqrt(dot(right, right));
  if (size == 0) {
    std::fill(x.begin(), x.end(), 0.0);
    return {};
  }
  const KrylovLimits limits{.reference = size,
                            .relative_residual = tolerance_.relative_residual,
                            .maximum_iterations = tolerance_.maximum_iterations};
  const SolveReport report = flexible_gmres(
      apply, [&](std::span<const double> in, std::span<double> out) { precondition(in, out); },
      std::span<const double>(right), x, limits, 60);
  if (null_space_) remove_mean(*null_space_, x);
  return report;
}

template <int dim>
std::string SaddlePointSolver<dim>::describe() const {
  return fmt::format("GMRES on velocity and pressure over {} nodes, preconditioned by a projection",
                     kinds_.size());
}

template class SaddlePointSolver<2>;
template class SaddlePointSolver<3>;

}  // namespace hemoscale::micro
