#pragma once

#include "micro/cells/ring_geometry.hpp"

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

}  // namespace hemoscale::micro
