#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "micro/vector.hpp"

namespace hemoscale::micro {

/// A smooth closed curve through the nodes of a ring, by trigonometric interpolation in the
/// parameter alpha_i = 2 pi i / n.
struct RingContour {
  std::vector<Vector<2>> positions;  // [m]
  std::vector<Vector<2>> tangents;   // [-] unit, counter-clockwise
  std::vector<Vector<2>> normals;    // [-] unit, outwards
  std::vector<double> lengths;       // [m] of arc that a node stands for, |dx/dalpha| 2 pi / n
  std::vector<double> curvatures;    // [1/m] positive where convex

  std::size_t size() const { return positions.size(); }
};

/// Derivatives and integrals along rings of n equidistant parameter values, of spectral accuracy:
/// trapezoidal sums for smooth integrands, and for those with a logarithm the rule of Kress 1991
/// (Martensen 1963), exact for trigonometric polynomials times ln(4 sin^2(t/2)).
class RingQuadrature {
 public:
  static constexpr std::size_t refinement_factor = 4;

  /// @param nodes  at least 8
  explicit RingQuadrature(std::size_t nodes);

  std::size_t nodes() const { return nodes_; }

  RingContour contour(std::span<const Vector<2>> positions) const;

  /// The sum over j of f_j times this at distance (i - j) in place of -ln|2 sin((a_i - a_j)/2)|,
  /// where f_j is the integrand times 2 pi / n.
  double log_weight(std::size_t i, std::size_t j) const {
    return log_weights_[i >= j ? i - j : i + nodes_ - j];
  }

  /// ln|2 sin((a_i - a_j) / 2)|; zero for i = j.
  double log_chord(std::size_t i, std::size_t j) const {
    return log_chords_[i >= j ? i - j : i + nodes_ - j];
  }

  /// Rows: values at refinement_factor times as many nodes, columns: values at the nodes; the first
  /// of each coincide.
  const Eigen::MatrixXd& refinement() const { return refinement_; }

 private:
  std::size_t nodes_;
  std::vector<double> log_weights_;
  std::vector<double> log_chords_;
  Eigen::MatrixXd derivative_;  // d/dalpha
  Eigen::MatrixXd refinement_;
};

}  // namespace hemoscale::micro
