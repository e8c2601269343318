#pragma once

#include "micro/cells/ring_geometry.hpp"
#include "micro/cells/ring_mesh.hpp"
#include "micro/cells/ring_stiffness.hpp"

namespace hemoscale::micro {

/// Linear stretching of the segments, per unit depth [Tsubota2006, section 3.1, "length of the
/// element"]:
///
///   E = (E_l / 2) sum_i l0_i ((l_i - l0_i) / l0_i)^2        [N]
///
/// Converges to the continuum (E_l / 2) int strain^2 ds with second order in the node spacing; the
/// modulus does not depend on the number of nodes. Sum of forces and torques zero; invalid for
/// coincident neighbours.
struct Stretch {
  double modulus = 0;  // [N/m] E_l: line tension per strain
};

/// @returns energy per unit depth [N]
inline double energy(const Stretch& law, const RingMesh& mesh, const RingGeometry& ring) {
  double sum = 0;
  for (std::size_t j = 0; j < ring.nodes; ++j) {
    const double extension = 1 / ring.inverse_length[j + 1] - mesh.rest_length[j];
    sum += extension * extension / mesh.rest_length[j];
  }
  return 0.5 * law.modulus * sum;
}

/// Adds the pulls of the segments; positive tension pulls the two ends together.
[[gnu::always_inline]] inline void add_loads(const Stretch& law, const RingMesh& mesh,
                                             RingGeometry& ring) {
  const double* const rest_length = mesh.rest_length.data();
  const double* const inverse_length = ring.inverse_length.data();
  const double* const dx = ring.dx.data();
  const double* const dy = ring.dy.data();
  double* const pull_x = ring.pull_x.data();
  double* const pull_y = ring.pull_y.data();
  const std::size_t n = ring.nodes;
  const double modulus = law.modulus;
  for (std::size_t j = 0; j < n; ++j) {
    // Tension over length, (l - l0) / (l0 l).
    const double ratio = modulus * (1 / rest_length[j] - inverse_length[j + 1]);
    pull_x[j + 1] += ratio * dx[j + 1];
    pull_y[j + 1] += ratio * dy[j + 1];
  }
  pull_x[0] = pull_x[n];
  pull_y[0] = pull_y[n];
}

/// Tension of segment j [N/m], positive where it is pulled.
inline double tension(const Stretch& law, const RingMesh& mesh, const RingGeometry& ring,
                      std::size_t j) {
  return law.modulus * (1 / (ring.inverse_length[j + 1] * mesh.rest_length[j]) - 1);
}

/// Adds the second derivatives.
inline void add_stiffness(const Stretch& law, const RingMesh& mesh, const RingGeometry& ring,
                          Compression compression, RingStiffness& stiffness) {
  for (std::size_t j = 0; j < ring.nodes; ++j) {
    add_tension_stiffness(ring, j, tension(law, mesh, ring, j), law.modulus / mesh.rest_length[j],
                          compression, stiffness);
  }
}

}  // namespace hemoscale::micro
