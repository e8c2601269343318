#pragma once

#include <Eigen/Core>
#include <vector>

#include "micro/cells/membrane.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Conditions of the minimum of the bending energy of a closed polygon whose n segments all have
/// the length h = 2 pi / n (radius R0 = 1, kappa = 1), at a given enclosed area.
///
/// Unknowns are the directions phi_j of the segments, so that every length is exact by
/// construction, and five multipliers:
///
///   sum_i e(phi_i - phi_{i-1}) + m . c(phi)  ->  stationary
///
///   e(theta) = theta^2 / (2 h)      or      (2/h) tan^2(theta / 2)
///   c = ( sum h cos phi, sum h sin phi           the polygon closes
///         A - A*,  A = (h^2/2) sum_{i<j} sin(phi_j - phi_i)
///         mean of phi - phi_circle,              no rotation
///         mean of (phi - phi_circle) cos 2s )    no sliding of the nodes along the shape
///
/// s is the angle of the segment on the circle. The last two conditions take away motions that
/// cost no energy; by the symmetry of the minimum about the x axis their multipliers vanish, so
/// that they do not change it.
class DeflationSystem {
 public:
  static constexpr int conditions = 5;
  static constexpr int area_condition = 2;  // place of A - A* among the conditions

  DeflationSystem(int nodes, BendingLaw law);

  int nodes() const { return nodes_; }
  int size() const { return nodes_ + conditions; }

  /// Directions of the circle with the second harmonic a sin 2s, a long axis along x.
  Eigen::VectorXd start(double amplitude) const;

  /// Gradient and Hessian (lower triangle) of the function above at (phi, m).
  void assemble(const Eigen::VectorXd& unknowns, double area, Eigen::VectorXd& gradient,
                Eigen::MatrixXd& hessian) const;

  double energy(const Eigen::VectorXd& unknowns) const;
  double area(const Eigen::VectorXd& unknowns) const;

  /// Corners of the polygon, the first in the origin.
  std::vector<Vector<2>> polygon(const Eigen::VectorXd& unknowns) const;

 private:
  double turn(const Eigen::VectorXd& unknowns, int node) const;
  void add_bending(const Eigen::VectorXd& unknowns, Eigen::VectorXd& gradient,
                   Eigen::MatrixXd& hessian) const;

  int nodes_;
  BendingLaw law_;
  double spacing_;
  Eigen::VectorXd circle_;   // [rad] directions of the circle
  Eigen::VectorXd sliding_;  // [-] cos 2s
};

/// Solves H x = b for a symmetric, indefinite matrix, overwriting both; H holds its factors after.
/// @returns the number of negative eigenvalues of H, or -1 if it is singular
int solve_symmetric(Eigen::MatrixXd& matrix, Eigen::Ref<Eigen::MatrixXd> right_sides);

}  // namespace hemoscale::micro
