#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "micro/cells/ring_geometry.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// What an implicit solver does with the geometric stiffness of segments under compression.
enum class Compression {
  full,    // second derivatives as they are: indefinite where a segment is pushed
  dropped  // max(T, 0): positive semi-definite; Newton's method then converges a little slower but
           // does not run into the buckling of single segments
};

/// Second derivatives of the energy of one ring, per unit depth:
///
///   H(i, j) = d2E / dX_i dX_j        [N/m^2]
///
/// The laws of elements and angles couple a node with two neighbours on each side; the enclosed
/// area couples all, by one outer product c g g^T. In rings of fewer than five nodes several
/// blocks belong to the same pair and add up.
struct RingStiffness {
  static constexpr int reach = 2;

  explicit RingStiffness(std::size_t node_count)
      : nodes(node_count), blocks(node_count), area_gradient(node_count, Vector<2>::Zero()) {
    clear();
  }

  /// Makes H zero.
  void clear();

  /// Block of node i and node i + offset, offset in [-2, 2].
  Tensor<2>& block(std::size_t i, int offset) {
    return blocks[i][static_cast<std::size_t>(offset + reach)];
  }

  std::size_t nodes;
  std::vector<std::array<Tensor<2>, 2 * reach + 1>> blocks;  // [N/m^2]
  double area_coefficient = 0;                               // [N/m^4] c
  std::vector<Vector<2>> area_gradient;                      // [m] g = dA/dX_i
};

/// Adds the second derivative S of an energy with respect to the vector of segment j.
inline void add_segment_stiffness(std::size_t j, const Tensor<2>& s, RingStiffness& stiffness) {
  const std::size_t next = j + 1 < stiffness.nodes ? j + 1 : 0;
  stiffness.block(j, 0) += s;
  stiffness.block(next, 0) += s;
  stiffness.block(j, 1) -= s;
  stiffness.block(next, -1) -= s;
}

/// Adds segment j under tension T that grows by `slope` = dT/dl, with the unit vector t along it:
///
///   S = (dT/dl) t t^T + (T/l) (I - t t^T)
///
/// @param tension  [N/m]
/// @param slope    [N/m^2]
inline void add_tension_stiffness(const RingGeometry& ring, std::size_t j, double tension,
                                  double slope, Compression compression, RingStiffness& stiffness) {
  const double inverse_length = ring.inverse_length[j + 1];
  const Vector<2> t(ring.dx[j + 1] * inverse_length, ring.dy[j + 1] * inverse_length);
  const bool drop = compression == Compression::dropped && tension < 0;
  const double across = drop ? 0 : tension * inverse_length;
  const Tensor<2> along = t * t.transpose();
  add_segment_stiffness(j, slope * along + across * (Tensor<2>::Identity() - along), stiffness);
}

/// result = H x, both of one value for each node; they may not be the same memory.
void multiply(const RingStiffness& stiffness, std::span<const Vector<2>> x,
              std::span<Vector<2>> result);

/// H as a full matrix over (x_0, y_0, x_1, ...).
Eigen::MatrixXd dense(const RingStiffness& stiffness);

}  // namespace hemoscale::micro
