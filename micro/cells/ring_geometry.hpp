#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace hemoscale::micro {

/// What the membrane laws need to know of the present shape of a ring, and where they put their
/// loads: scratch memory that is reused from ring to ring. Segment arrays are shifted by one, so
/// that loops along the ring need no wrapping: entry j + 1 belongs to segment j, entry 0 repeats
/// the last segment.
struct RingGeometry {
  explicit RingGeometry(int node_count)
      : nodes(static_cast<std::size_t>(node_count)),
        dx(nodes + 1),
        dy(nodes + 1),
        inverse_length(nodes + 1),
        half_tangent(nodes),
        pull_x(nodes + 1),
        pull_y(nodes + 1),
        moment(nodes + 1) {}

  std::size_t nodes;
  std::vector<double> dx, dy;          // [m] segment vectors
  std::vector<double> inverse_length;  // [1/m]
  std::vector<double> half_tangent;    // [-] tan(theta/2) of the turning angle at node i
  double area = 0;                     // [m^2] enclosed

  // Loads. Segment j pulls node j by +pull and node j + 1 by -pull, so that no law can exert a net
  // force.
  std::vector<double> pull_x, pull_y;  // [N/m] shifted by one like the segments
  double pressure = 0;                 // [Pa] inside over outside
  std::vector<double> moment;  // [N] scratch of the bending laws: dE/dtheta per node, closed
};

/// Shape of a ring from its positions; loads are set to zero.
///
/// tan(theta/2) = c / (h + d) with c and d the cross and scalar products of neighbouring segments
/// and h the product of their lengths; for obtuse turns (h - d) / c, which does not cancel. It
/// needs neither a square root nor an inverse tangent, and is exact but for round-off.
[[gnu::always_inline]] inline void measure(const double* x, const double* y, RingGeometry& ring) {
  const std::size_t n = ring.nodes;
  double* const dx = ring.dx.data();
  double* const dy = ring.dy.data();
  double* const inverse_length = ring.inverse_length.data();
  for (std::size_t j = 0; j + 1 < n; ++j) {
    dx[j + 1] = x[j + 1] - x[j];
    dy[j + 1] = y[j + 1] - y[j];
  }
  dx[0] = dx[n] = x[0] - x[n - 1];
  dy[0] = dy[n] = y[0] - y[n - 1];
  for (std::size_t j = 0; j <= n; ++j) {
    inverse_length[j] = 1 / std::sqrt(dx[j] * dx[j] + dy[j] * dy[j]);
  }
  double* const half_tangent = ring.half_tangent.data();
  for (std::size_t i = 0; i < n; ++i) {
    // Unit vectors: the products below are sine and cosine, h is one.
    const double scale = inverse_length[i] * inverse_length[i + 1];
    const double sine = (dx[i] * dy[i + 1] - dy[i] * dx[i + 1]) * scale;
    const double cosine = (dx[i] * dx[i + 1] + dy[i] * dy[i + 1]) * scale;
    const bool acute = cosine >= 0;
    half_tangent[i] = (acute ? sine : 1 - cosine) / (acute ? 1 + cosine : sine);
  }
  // Four partial sums: the order is fixed, and the additions do not wait for each other.
  double sum[4] = {0, 0, 0, 0};
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    for (std::size_t k = 0; k < 4; ++k) {
      sum[k] += (x[i + k] - x[0]) * dy[i + k + 1] - (y[i + k] - y[0]) * dx[i + k + 1];
    }
  }
  for (; i < n; ++i) {
    sum[0] += (x[i] - x[0]) * dy[i + 1] - (y[i] - y[0]) * dx[i + 1];
  }
  ring.area = 0.5 * ((sum[0] + sum[2]) + (sum[1] + sum[3]));
  for (std::size_t j = 0; j <= n; ++j) {
    ring.pull_x[j] = 0;
    ring.pull_y[j] = 0;
  }
  ring.pressure = 0;
}

/// Node forces of the collected loads: the pulls of both segments, and the pressure on half of
/// each.
/// @param force_x, force_y  [N/m] overwritten
[[gnu::always_inline]] inline void assemble(const RingGeometry& ring, double* force_x,
                                            double* force_y) {
  const double* const dx = ring.dx.data();
  const double* const dy = ring.dy.data();
  const double* const pull_x = ring.pull_x.data();
  const double* const pull_y = ring.pull_y.data();
  const double half_pressure = 0.5 * ring.pressure;
  const std::size_t n = ring.nodes;
  for (std::size_t i = 0; i < n; ++i) {
    force_x[i] = (pull_x[i + 1] - pull_x[i]) + half_pressure * (dy[i] + dy[i + 1]);
    force_y[i] = (pull_y[i + 1] - pull_y[i]) - half_pressure * (dx[i] + dx[i + 1]);
  }
}

}  // namespace hemoscale::micro
