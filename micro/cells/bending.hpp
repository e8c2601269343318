#pragma once

#include "micro/cells/ring_geometry.hpp"
#include "micro/cells/ring_stiffness.hpp"

namespace hemoscale::micro {

/// Turns the moments of the bending laws, M_i = dE/dtheta_i, into pulls of the segments.
///
/// theta_i is the direction of segment i minus that of segment i - 1. Segment j thus feels the
/// torque M_j - M_{j+1} against its rotation, which is a pair of opposite forces across it:
/// pull_j = (M_j - M_{j+1}) / l^2 * (-dy, dx). Net force and torque vanish by construction.
///
/// @pre entry n of ring.moment repeats entry 0
[[gnu::always_inline]] inline void add_moment_pulls(RingGeometry& ring) {
  const double* const moment = ring.moment.data();
  const double* const inverse_length = ring.inverse_length.data();
  const double* const dx = ring.dx.data();
  const double* const dy = ring.dy.data();
  double* const pull_x = ring.pull_x.data();
  double* const pull_y = ring.pull_y.data();
  const std::size_t n = ring.nodes;
  for (std::size_t j = 0; j < n; ++j) {
    const double torque =
        (moment[j] - moment[j + 1]) * inverse_length[j + 1] * inverse_length[j + 1];
    pull_x[j + 1] -= torque * dy[j + 1];
    pull_y[j + 1] += torque * dx[j + 1];
  }
  pull_x[0] = pull_x[n];
  pull_y[0] = pull_y[n];
}

/// Adds the second derivatives of the bending laws, B_i = dM_i/dtheta_i:
///
///   H += sum_i B_i (dtheta_i/dX)(dtheta_i/dX)^T + sum_j (M_j - M_{j+1}) d2phi_j/dX2
///
/// phi_j is the direction of segment j, so that theta_i = phi_i - phi_{i-1}. With t along the
/// segment and n to its left dphi/dd = n/l and d2phi/dd2 = -(t n^T + n t^T)/l^2.
///
/// @param slope_at  slope_at(i) = B_i [N]
/// @pre entry n of ring.moment repeats entry 0
template <class Slope>
void add_moment_stiffness(const RingGeometry& ring, const Slope& slope_at,
                          RingStiffness& stiffness) {
  const std::size_t n = ring.nodes;
  const auto direction_gradient = [&](std::size_t shifted) {
    const double square = ring.inverse_length[shifted] * ring.inverse_length[shifted];
    return Vector<2>(-ring.dy[shifted] * square, ring.dx[shifted] * square);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = i > 0 ? i - 1 : n - 1;
    const std::size_t after = i + 1 < n ? i + 1 : 0;
    const Vector<2> incoming = direction_gradient(i);  // also dtheta/dX of the node before
    const Vector<2> outgoing = direction_gradient(i + 1);
    const Vector<2> own = -incoming - outgoing;
    const double slope = slope_at(i);
    const Vector<2> b_incoming = slope * incoming;
    const Vector<2> b_own = slope * own;
    const Vector<2> b_outgoing = slope * outgoing;
    stiffness.block(before, 0) += b_incoming * incoming.transpose();
    stiffness.block(before, 1) += b_incoming * own.transpose();
    stiffness.block(before, 2) += b_incoming * outgoing.transpose();
    stiffness.block(i, -1) += b_own * incoming.transpose();
    stiffness.block(i, 0) += b_own * own.transpose();
    stiffness.block(i, 1) += b_own * outgoing.transpose();
    stiffness.block(after, -2) += b_outgoing * incoming.transpose();
    stiffness.block(after, -1) += b_outgoing * own.transpose();
    stiffness.block(after, 0) += b_outgoing * outgoing.transpose();
    // Segment i: the moments at its ends against its rotation.
    const double torque = ring.moment[i] - ring.moment[i + 1];
    const Vector<2> along(ring.dx[i + 1], ring.dy[i + 1]);
    const double square = ring.inverse_length[i + 1] * ring.inverse_length[i + 1];
    const Tensor<2> product = along * outgoing.transpose();
    add_segment_stiffness(i, -torque * square * (product + product.transpose()), stiffness);
  }
}

}  // namespace hemoscale::micro
