#include "micro/mps/coupled_solver.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "micro/mps/block_pattern.hpp"

namespace hemoscale::micro {

namespace {

/// Orthonormal vectors across `normal`, as rows.
template <int dim>
Eigen::Matrix<double, dim - 1, dim> tangents(const Vector<dim>& normal) {
  if constexpr (dim == 2) {
    return Eigen::Matrix<double, 1, 2>(-normal[1], normal[0]);
  } else {
    const Vector<3> first = normal.unitOrthogonal();
    Eigen::Matrix<double, 2, 3> rows;
    rows.row(0) = first.transpose();
    rows.row(1) = normal.cross(first).transpose();
    return rows;
  }
}

}  // namespace

// Unknowns are velocities and q = p l0 / m, m = mu + rho a0 l0^2, a velocity too; momentum is
// multiplied by l0^2 / m and continuity by l0, so that all entries are of order one whatever the
// units and the regime.

template <int dim>
CoupledSolver<dim>::CoupledSolver(const Fluid& fluid, double stabilisation,
                                  const StageSolving& solving, const Communicator& ranks)
    : fluid_(fluid), stabilisation_(stabilisation), solving_(solving), ranks_(ranks) {}

template <int dim>
void CoupledSolver<dim>::prepare(const NodeGeometry<dim>& nodes, double rate) {
  rate_ = rate;
  const double inertia = fluid_.density * rate * nodes.spacing * nodes.spacing;
  viscosity_scale_ = fluid_.viscosity() + inertia;
  const NodeRange own = nodes.stencils.rows(nodes.size());
  matrix_ = SparseMatrix(block_pattern(nodes.table, dim + 1, own));
  assemble(nodes);
  if (nodes.stencils.ranks != nullptr) gather_matrix(nodes);
  SystemTraits traits{.unknowns_per_node = dim + 1};
  if (has_free_pressure_level(nodes.kinds)) {
    traits.null_space =
        ConstantNullSpace{static_cast<std::size_t>(dim), static_cast<std::size_t>(dim + 1)};
  }
  // Every rank solves the whole.
  if (solving_.kind == LinearSolverKind::aggregate) {
    solver_ = std::make_unique<SaddlePointSolver<dim>>(nodes, scaled_coefficients(nodes.spacing),
                                                       solving_.tolerance, traits.null_space);
  } else {
    solver_ = make_node_solver(nodes, *matrix_.pattern, traits, solving_, alone_);
  }
  solver_->prepare(matrix_);
}

template <int dim>
SaddlePointCoefficients CoupledSolver<dim>::scaled_coefficients(double spacing) const {
  const double squared = spacing * spacing;
  const double friction = fluid_.viscosity() / viscosity_scale_;
  SaddlePointCoefficients c;
  c.inertia = fluid_.density * rate_ * squared / viscosity_scale_;
  c.viscous = friction * squared;
  c.smoothing = squared / (c.inertia + stabilisation_ * friction);
  return c;
}

template <int dim>
void CoupledSolver<dim>::gather_matrix(const NodeGeometry<dim>& nodes) {
  const SparseMatrix own = std::move(matrix_);
  matrix_ = SparseMatrix(block_pattern(nodes.table, dim + 1, {0, nodes.size()}));
  ranks_.all_gather_ranges(own.values.data(), own.values.size(), matrix_.values.data(),
                           matrix_.values.size());
}

template <int dim>
void CoupledSolver<dim>::assemble(const NodeGeometry<dim>& nodes) {
  const double l = nodes.spacing;
  const auto [inertia, viscous, smoothing] = scaled_coefficients(l);
  const NeighbourTable& table = nodes.table;
  const NodeRange own = nodes.stencils.rows(nodes.size());
#pragma omp parallel for schedule(static)
  for (std::size_t i = own.begin; i < own.end; ++i) {
    BlockRow row(matrix_, table, dim + 1, i);
    const ParticleKind kind = nodes.kinds[i];
    const Vector<dim>& normal = nodes.normals[i];
    if (has_momentum(kind)) {
      for (int c = 0; c < dim; ++c) row.add_own(c, c, inertia);
    } else if (has_given_velocity(kind)) {
      for (int c = 0; c < dim; ++c) row.add_own(c, c, 1);
    } else if (kind == ParticleKind::outlet) {
      const Eigen::Matrix<double, dim - 1, dim> across = tangents<dim>(normal);
      for (int t = 0; t < dim - 1; ++t) {
        for (int c = 0; c < dim; ++c) row.add_own(t + 1, c, across(t, c));
      }
    }
    if (has_given_pressure(kind)) row.add_own(dim, dim, 1);

    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      const Vector<dim>& gradient = nodes.stencils.gradient[k];
      const double laplacian = nodes.stencils.laplacian[k];
      if (has_momentum(kind)) {
        for (int c = 0; c < dim; ++c) {
          row.add_difference(c, k, c, -viscous * laplacian);
          row.add_difference(c, k, dim, l * gradient[c]);
        }
      }
      if (kind == ParticleKind::fluid) {
        for (int c = 0; c < dim; ++c) row.add_difference(dim, k, c, l * gradient[c]);
        row.add_difference(dim, k, dim, -smoothing * laplacian);
      } else if (has_given_velocity(kind)) {
        row.add_difference(dim, k, dim, l * normal.dot(gradient));
        for (int c = 0; c < dim; ++c) {
          row.add_difference(dim, k, c, -viscous * normal[c] * laplacian);
        }
      } else if (kind == ParticleKind::outlet) {
        for (int c = 0; c < dim; ++c) {
          row.add_difference(0, k, c, l * normal[c] * normal.dot(gradient));
        }
      }
    }
  }
}

template <int dim>
SolveReport CoupledSolver<dim>::solve(const NodeGeometry<dim>& nodes,
                                      const StageProblem<dim>& problem,
                                      std::vector<Vector<dim>>& velocities,
                                      std::vector<double>& pressures) {
  const std::size_t count = nodes.size();
  const double l = nodes.spacing;
  const double pressure_unit = viscosity_scale_ / l;                     // [Pa s/m]
  const double source_unit = fluid_.density * l * l / viscosity_scale_;  // [s]
  const double smoothing = scaled_coefficients(l).smoothing;

  std::vector<double> wide_laplacian(count, 0.0);  // D G p_before [Pa/m^2]
  if (std::any_of(pressures.begin(), pressures.end(), [](double p) { return p != 0; })) {
    std::vector<Vector<dim>> gradient;
    apply_gradient(nodes.stencils, nodes.table, pressures, gradient);
    apply_divergence(nodes.stencils, nodes.table, gradient, wide_laplacian);
  }

  constexpr auto block = static_cast<std::size_t>(dim + 1);
  std::vector<double> right(block * count);
  std::vector<double> solution(block * count);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    double* row = right.data() + block * i;
    const ParticleKind kind = nodes.kinds[i];
    for (std::size_t c = 0; c < dim; ++c) {
      const auto axis = static_cast<Eigen::Index>(c);
      if (has_momentum(kind)) row[c] = source_unit * problem.source[i][axis];
      if (has_given_velocity(kind)) row[c] = problem.velocity[i][axis];
    }
    if (kind == ParticleKind::outlet) {
      if (!problem.outflow_rate.empty()) row[0] = l * problem.outflow_rate[i];
      const Eigen::Matrix<double, dim - 1, dim> across = tangents<dim>(nodes.normals[i]);
      for (int t = 0; t < dim - 1; ++t) row[t + 1] = across.row(t).dot(problem.velocity[i]);
    }
    if (has_given_pressure(kind)) {
      row[dim] = problem.pressure[i] / pressure_unit;
    } else if (has_given_velocity(kind)) {
      row[dim] = source_unit * nodes.normals[i].dot(problem.source[i]);
    } else {
      row[dim] = -smoothing * wide_laplacian[i] / pressure_unit;
    }
    for (std::size_t c = 0; c < dim; ++c) {
      solution[block * i + c] = velocities[i][static_cast<Eigen::Index>(c)];
    }
    solution[block * i + dim] = pressures[i] / pressure_unit;
  }
  const SolveReport report = solver_->solve(right, solution);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < dim; ++c) {
      velocities[i][static_cast<Eigen::Index>(c)] = solution[block * i + c];
    }
    pressures[i] = solution[block * i + dim] * pressure_unit;
  }
  return report;
}

template <int dim>
std::string CoupledSolver<dim>::describe() const {
  return solver_ ? solver_->describe() : "not prepared";
}

template class CoupledSolver<2>;
template class CoupledSolver<3>;

}  // namespace hemoscale::micro
