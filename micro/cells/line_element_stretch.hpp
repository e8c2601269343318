#pragma once

#include "micro/cells/ring_geometry.hpp"
#include "micro/cells/ring_mesh.hpp"
#include "micro/cells/ring_stiffness.hpp"

namespace hemoscale::micro {

/// Linear stretching with one constant for all elements, per unit depth: the form of the paper's
/// membrane [Tsubota2006, section 3.1, "length of the element"]:
///
///   E = (k_l / 2) sum_i ((l_i - l0_i) / l0_i)^2        [N]
///
/// The mapping k_l = E_l l0 makes it the law `Stretch` where all elements have the rest length l0,
/// and its continuum limit (E_l / 2) int strain^2 ds, reached with second order. Where rest
/// lengths differ, the local modulus is k_l / l0_i: short elements are stiffer. Sum of forces and
/// torques zero; invalid for coincident neighbours.
struct LineElementStretch {
  double modulus = 0;  // [N] k_l = E_l l0
};

/// @returns energy per unit depth [N]
inline double energy(const LineElementStretch& law, const RingMesh& mesh,
                     const RingGeometry& ring) {
  double sum = 0;
  for (std::size_t j = 0; j < ring.nodes; ++j) {
    const double strain = 1 / (ring.inverse_length[j + 1] * mesh.rest_length[j]) - 1;
    sum += strain * strain;
  }
  return 0.5 * law.modulus * sum;
}

/// Tension of segment j [N/m], positive where it is pulled.
inline double tension(const LineElementStretch& law, const RingMesh& mesh, const RingGeometry& ring,
                      std::size_t j) {
  const double extension = 1 / ring.inverse_length[j + 1] - mesh.rest_length[j];
  return law.modulus * extension / (mesh.rest_length[j] * mesh.rest_length[j]);
}

/// Adds the pulls of the segments; positive tension pulls the two ends together.
inline void add_loads(const LineElementStretch& law, const RingMesh& mesh, RingGeometry& ring) {
  for (std::size_t j = 0; j < ring.nodes; ++j) {
    const double ratio = tension(law, mesh, ring, j) * ring.inverse_length[j + 1];
    ring.pull_x[j + 1] += ratio * ring.dx[j + 1];
    ring.pull_y[j + 1] += ratio * ring.dy[j + 1];
  }
  ring.pull_x[0] = ring.pull_x[ring.nodes];
  ring.pull_y[0] = ring.pull_y[ring.nodes];
}

/// Adds the second derivatives.
inline void add_stiffness(const LineElementStretch& law, const RingMesh& mesh,
                          const RingGeometry& ring, Compression compression,
                          RingStiffness& stiffness) {
  for (std::size_t j = 0; j < ring.nodes; ++j) {
    const double slope = law.modulus / (mesh.rest_length[j] * mesh.rest_length[j]);
    add_tension_stiffness(ring, j, tension(law, mesh, ring, j), slope, compression, stiffness);
  }
}

}  // namespace hemoscale::micro
