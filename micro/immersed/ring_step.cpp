#include "micro/immersed/ring_step.hpp"

#include <fmt/format.h>
#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "micro/cells/outline_checks.hpp"
#include "micro/error.hpp"
#include "micro/linear/one_blas_thread.hpp"

namespace hemoscale::micro {

namespace {

using Matrix = Eigen::MatrixXd;
using Column = Eigen::VectorXd;

struct Segment {
  double length = 0;  // [m]
  Vector<2> direction;
};

Segment segment(std::span<const Vector<2>> x, std::size_t k) {
  const Vector<2> d = x[(k + 1) % x.size()] - x[k];
  const double length = d.norm();
  return {length, d / length};
}

Eigen::Index column_of(std::size_t node) {
  return static_cast<Eigen::Index>(2 * node);
}

/// Second derivatives of energy and tensions as blocks of a ring.
RingStiffness stiffness_of(const RingStep& step, const RingUnknowns& u) {
  const std::size_t n = u.positions.size();
  RingStiffness stiffness(n);
  step.resistance->stiffness(u.positions, Compression::dropped, stiffness);
  for (std::size_t k = 0; k < n; ++k) {
    if (!(u.tensions[k] > 0)) continue;
    const auto [length, t] = segment(u.positions, k);
    const Eigen::Matrix2d geometric =
        u.tensions[k] / length * (Eigen::Matrix2d::Identity() - t * t.transpose());
    const std::size_t next = (k + 1) % n;
    stiffness.block(k, 0) += geometric;
    stiffness.block(next, 0) += geometric;
    stiffness.block(k, 1) -= geometric;
    stiffness.block(next, -1) -= geometric;
  }
  return stiffness;
}

/// The Newton matrix over (x / R, tau / tau0, beta / (rate R)) and the residuals, all of order one.
class RingSystem {
 public:
  RingSystem(const RingStep& step, std::size_t nodes)
      : step_(step),
        nodes_(nodes),
        size_(static_cast<Eigen::Index>(3 * nodes + (step.holds_area ? 1 : 0))),
        radius_(step.resistance->mesh().rest_perimeter / (2 * M_PI)),
        velocity_(step.rate * radius_),
        tension_(12 * step.friction * velocity_),
        matrix_(size_, size_),
        right_(size_),
        pivots_(static_cast<std::size_t>(size_)) {}

  /// Right-hand side: minus the residuals. @returns its largest entry
  double measure(const RingUnknowns& u) {
    const std::size_t n = nodes_;
    const std::vector<Vector<2>> forces =
        elastic_forces(*step_.resistance, u.positions, u.tensions);
    Column f(static_cast<Eigen::Index>(2 * n));
    for (std::size_t i = 0; i < n; ++i) f.segment<2>(column_of(i)) = forces[i];
    const Column driven = *step_.mobility * f;
    for (std::size_t i = 0; i < n; ++i) {
      const Vector<2> excess = step_.rate * u.positions[i] - step_.known[i] - step_.ambient[i] -
                               Vector<2>(driven.segment<2>(column_of(i))) -
                               u.leak * step_.normals[i];
      right_.segment<2>(column_of(i)) = -excess / velocity_;
    }
    const RingMesh& mesh = step_.resistance->mesh();
    for (std::size_t k = 0; k < n; ++k) {
      const double strain = segment(u.positions, k).length / mesh.rest_length[k] - 1;
      const double scale = 1 + step_.compliances[k] * tension_;
      right_[tension_row(k)] = -(strain - step_.compliances[k] * u.tensions[k]) / scale;
    }
    if (step_.holds_area) {
      right_[size_ - 1] =
          -(enclosed_area(u.positions) - mesh.rest_area) / (radius_ * mesh.rest_perimeter);
    }
    return right_.cwiseAbs().maxCoeff();
  }

  void assemble(const RingUnknowns& u) {
    const std::size_t n = nodes_;
    const Matrix& w = *step_.mobility;
    matrix_.setZero();
    const RingStiffness stiffness = stiffness_of(step_, u);
    const auto rows = static_cast<Eigen::Index>(2 * n);
    const double by_position = radius_ / velocity_;
    for (std::size_t i = 0; i < n; ++i) {
      // Column block of node j gathers W(:, i) H(i, j).
      for (int offset = -RingStiffness::reach; offset <= RingStiffness::reach; ++offset) {
        const std::size_t j = (i + n + static_cast<std::size_t>(offset + static_cast<int>(n))) % n;
        matrix_.block(0, column_of(j), rows, 2).noalias() +=
            by_position * w.middleCols<2>(column_of(i)) *
            stiffness.blocks[i][static_cast<std::size_t>(offset + RingStiffness::reach)];
      }
      matrix_(column_of(i), column_of(i)) += 1;
      matrix_(column_of(i) + 1, column_of(i) + 1) += 1;
    }
    if (stiffness.area_coefficient != 0) {
      Column g(rows);
      for (std::size_t i = 0; i < n; ++i) g.segment<2>(column_of(i)) = stiffness.area_gradient[i];
      matrix_.topLeftCorner(rows, rows).noalias() +=
          (by_position * stiffness.area_coefficient) * (w * g) * g.transpose();
    }
    const RingMesh& mesh = step_.resistance->mesh();
    const double by_tension = tension_ / velocity_;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t next = (k + 1) % n;
      const auto [length, t] = segment(u.positions, k);
      const Eigen::Index row = tension_row(k);
      // Tension pulls both ends of the segment together.
      matrix_.col(row).head(rows) =
          -by_tension * (w.middleCols<2>(column_of(k)) * t - w.middleCols<2>(column_of(next)) * t);
      const double scale = 1 + step_.compliances[k] * tension_;
      const double slope = radius_ / (mesh.rest_length[k] * scale);
      matrix_.block<1, 2>(row, column_of(k)) = -slope * t.transpose();
      matrix_.block<1, 2>(row, column_of(next)) = slope * t.transpose();
      matrix_(row, row) = -step_.compliances[k] * tension_ / scale;
    }
    if (!step_.holds_area) return;
    for (std::size_t i = 0; i < n; ++i) {
      matrix_.col(size_ - 1).segment<2>(column_of(i)) = -step_.normals[i];
      const Vector<2> across =
          u.positions[(i + 1) % n] - u.positions[(i + n - 1) % n];  // twice the gradient, turned
      matrix_.block<1, 2>(size_ - 1, column_of(i)) =
          Vector<2>(across.y(), -across.x()).transpose() / (2 * mesh.rest_perimeter);
    }
  }

  void factor() {
    use_one_blas_thread();
    const auto size = static_cast<lapack_int>(size_);
    if (LAPACKE_dgetrf(LAPACK_COL_MAJOR, size, size, matrix_.data(), size, pivots_.data()) != 0) {
      throw NumericalError("the step of the membrane has no unique solution; shorten the step");
    }
  }

  void solve() {
    const auto size = static_cast<lapack_int>(size_);
    LAPACKE_dgetrs(LAPACK_COL_MAJOR, 'N', size, 1, matrix_.data(), size, pivots_.data(),
                   right_.data(), size);
  }

  /// Adds the solution. @returns the largest displacement over the size of the ring
  double apply(double share, RingUnknowns& u) const {
    double largest = 0;
    for (std::size_t i = 0; i < nodes_; ++i) {
      const Vector<2> d = right_.segment<2>(column_of(i));
      largest = std::max(largest, d.norm());
      u.positions[i] += share * radius_ * d;
      u.tensions[i] += share * tension_ * right_[tension_row(i)];
    }
    if (step_.holds_area) u.leak += share * velocity_ * right_[size_ - 1];
    return largest;
  }

 private:
  Eigen::Index tension_row(std::size_t k) const {
    return static_cast<Eigen::Index>(2 * nodes_ + k);
  }

  const RingStep& step_;
  std::size_t nodes_;
  Eigen::Index size_;
  double radius_;    // [m]
  double velocity_;  // [m/s]
  double tension_;   // [N/m]
  Matrix matrix_;
  Column right_;
  std::vector<lapack_int> pivots_;
};

}  // namespace

std::vector<Vector<2>> elastic_forces(const RingMembrane& resistance,
                                      std::span<const Vector<2>> positions,
                                      std::span<const double> tensions) {
  const std::size_t n = positions.size();
  std::vector<Vector<2>> forces(n);
  resistance.forces(positions, forces);
  for (std::size_t k = 0; k < n; ++k) {
    const Vector<2> pull = tensions[k] * segment(positions, k).direction;
    forces[k] += pull;
    forces[(k + 1) % n] -= pull;
  }
  return forces;
}

RingReport solve_ring(const RingStep& step, RingUnknowns& unknowns) {
  constexpr int most_iterations = 100;
  constexpr double wanted = 1e-10;  // [-] displacement over the size
  constexpr double enough = 1e-8;   // [-] the same, where rounding lets it become no smaller
  constexpr double slow = 0.2;      // [-] contraction below which old factors are good enough
  RingSystem system(step, unknowns.positions.size());
  RingReport report;
  bool is_factored = false;
  double last = std::numeric_limits<double>::infinity();
  while (report.iterations < most_iterations) {
    system.measure(unknowns);
    const bool is_fresh = !is_factored;
    if (is_fresh) {
      system.assemble(unknowns);
      system.factor();
      ++report.factorisations;
    }
    system.solve();
    report.change = system.apply(1, unknowns);
    ++report.iterations;
    if (report.change < wanted) return report;
    if (is_fresh && report.change < enough && report.change > 0.5 * last) return report;
    if (!std::isfinite(report.change)) break;
    is_factored = report.change < slow * last;
    last = report.change;
  }
  throw NumericalError(
      fmt::format("the membrane did not reach its new place in {} iterations of Newton's method: "
                  "the last moved it by {:.3g} of its size; shorten the step",
                  report.iterations, report.change));
}

}  // namespace hemoscale::micro
