#include "micro/cells/deflation_system.hpp"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "micro/linear/one_blas_thread.hpp"

namespace hemoscale::micro {

DeflationSystem::DeflationSystem(int nodes, BendingLaw law)
    : nodes_(nodes),
      law_(law),
      spacing_(2 * std::numbers::pi / nodes),
      circle_(nodes),
      sliding_(nodes) {
  for (int j = 0; j < nodes; ++j) {
    const double s = (j + 0.5) * spacing_;
    circle_(j) = s + 0.5 * std::numbers::pi;
    sliding_(j) = std::cos(2 * s);
  }
}

Eigen::VectorXd DeflationSystem::start(double amplitude) const {
  Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(size());
  for (int j = 0; j < nodes_; ++j) {
    unknowns(j) = circle_(j) + amplitude * std::sin(2 * (j + 0.5) * spacing_);
  }
  return unknowns;
}

double DeflationSystem::turn(const Eigen::VectorXd& unknowns, int node) const {
  return node > 0 ? unknowns(node) - unknowns(node - 1)
                  : unknowns(0) - unknowns(nodes_ - 1) + 2 * std::numbers::pi;
}

double DeflationSystem::energy(const Eigen::VectorXd& unknowns) const {
  double sum = 0;
  for (int i = 0; i < nodes_; ++i) {
    const double theta = turn(unknowns, i);
    const double t = std::tan(0.5 * theta);
    sum += law_ == BendingLaw::turning_angle ? 0.5 * theta * theta : 2 * t * t;
  }
  return sum / spacing_;
}

double DeflationSystem::area(const Eigen::VectorXd& unknowns) const {
  double x = 0;
  double y = 0;
  double sum = 0;
  for (int j = 0; j < nodes_; ++j) {
    const double dx = std::cos(unknowns(j));
    const double dy = std::sin(unknowns(j));
    sum += x * dy - y * dx;
    x += dx;
    y += dy;
  }
  return 0.5 * spacing_ * spacing_ * sum;
}

std::vector<Vector<2>> DeflationSystem::polygon(const Eigen::VectorXd& unknowns) const {
  std::vector<Vector<2>> corners;
  Vector<2> corner = Vector<2>::Zero();
  for (int j = 0; j < nodes_; ++j) {
    corners.push_back(corner);
    corner += spacing_ * Vector<2>(std::cos(unknowns(j)), std::sin(unknowns(j)));
  }
  return corners;
}

void DeflationSystem::add_bending(const Eigen::VectorXd& unknowns, Eigen::VectorXd& gradient,
                                  Eigen::MatrixXd& hessian) const {
  for (int i = 0; i < nodes_; ++i) {
    const double theta = turn(unknowns, i);
    double moment = theta / spacing_;
    double slope = 1 / spacing_;
    if (law_ == BendingLaw::half_angle_tangent) {
      const double t = std::tan(0.5 * theta);
      moment = 2 * t * (1 + t * t) / spacing_;
      slope = (1 + t * t) * (1 + 3 * t * t) / spacing_;
    }
    const int before = i > 0 ? i - 1 : nodes_ - 1;
    gradient(i) += moment;
    gradient(before) -= moment;
    hessian(i, i) += slope;
    hessian(before, before) += slope;
    hessian(std::max(i, before), std::min(i, before)) -= slope;
  }
}

void DeflationSystem::assemble(const Eigen::VectorXd& unknowns, double wanted_area,
                               Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian) const {
  const int n = nodes_;
  const double h = spacing_;
  const Eigen::VectorXd dx = h * unknowns.head(n).array().cos();
  const Eigen::VectorXd dy = h * unknowns.head(n).array().sin();
  const auto m = unknowns.tail<conditions>();
  gradient.setZero(size());
  hessian.setZero(size(), size());
  add_bending(unknowns, gradient, hessian);
  // Derivatives of the area: dA/dphi_j = (t_j . w_j) / 2, w_j the sum of the segments before j less
  // that of those behind.
  const double end_x = dx.sum();
  const double end_y = dy.sum();
  double x = 0;
  double y = 0;
  double area = 0;
  for (int j = 0; j < n; ++j) {
    area += 0.5 * (x * dy(j) - y * dx(j));
    const double w_x = 2 * x + dx(j) - end_x;
    const double w_y = 2 * y + dy(j) - end_y;
    const double slope = 0.5 * (dx(j) * w_x + dy(j) * w_y);
    const double area_diagonal = 0.5 * (dx(j) * w_y - dy(j) * w_x);
    // d2A/dphi_i dphi_j = (d_j x d_i) / 2 for i behind j.
    for (int i = j + 1; i < n; ++i) {
      hessian(i, j) += 0.5 * m(area_condition) * (dx(j) * dy(i) - dy(j) * dx(i));
    }
    hessian(j, j) += m(area_condition) * area_diagonal - m(0) * dx(j) - m(1) * dy(j);
    hessian(n, j) = -dy(j);
    hessian(n + 1, j) = dx(j);
    hessian(n + 2, j) = slope;
    hessian(n + 3, j) = 1.0 / n;
    hessian(n + 4, j) = sliding_(j) / n;
    x += dx(j);
    y += dy(j);
  }
  gradient.head(n) += hessian.block(n, 0, conditions, n).transpose() * m;
  const Eigen::VectorXd turned = unknowns.head(n) - circle_;
  gradient.tail<conditions>() << end_x, end_y, area - wanted_area, turned.mean(),
      turned.dot(sliding_) / n;
}

int solve_symmetric(Eigen::MatrixXd& matrix, Eigen::Ref<Eigen::MatrixXd> right_sides) {
  use_one_blas_thread();
  const auto n = static_cast<lapack_int>(matrix.rows());
  std::vector<lapack_int> pivots(static_cast<std::size_t>(n));
  Eigen::VectorXd work(64 * n);
  const lapack_int failed =
      LAPACKE_dsytrf_work(LAPACK_COL_MAJOR, 'L', n, matrix.data(), n, pivots.data(), work.data(),
                          static_cast<lapack_int>(work.size()));
  if (failed != 0) {
    return -1;
  }
  LAPACKE_dsytrs_work(LAPACK_COL_MAJOR, 'L', n, static_cast<lapack_int>(right_sides.cols()),
                      matrix.data(), n, pivots.data(), right_sides.data(),
                      static_cast<lapack_int>(right_sides.outerStride()));
  // Sylvester: the block diagonal factor has the signs of the matrix. Blocks of two rows are
  // marked by negative pivots and have one eigenvalue of each sign.
  int negative = 0;
  for (lapack_int i = 0; i < n; ++i) {
    if (pivots[static_cast<std::size_t>(i)] < 0) {
      ++negative;
      ++i;
    } else if (matrix(i, i) < 0) {
      ++negative;
    }
  }
  return negative;
}

}  // namespace hemoscale::micro
