#pragma once

#include "micro/cells/ring_geometry.hpp"
#include "micro/cells/ring_mesh.hpp"
#include "micro/cells/ring_stiffness.hpp"

namespace hemoscale::micro {

/// Penalty for a change of the enclosed area, per unit depth, which acts as a pressure inside
/// [Tsubota2006, section 3.1, "areal constraint"]:
///
///   E = (k_A / 2) (A - A0)^2 / A0        [N],     pressure = -k_A (A - A0) / A0        [Pa]
///
/// k_A is the pressure per relative change of area, hence in Pa.
struct AreaPenalty {
  double modulus = 0;  // [Pa] k_A
};

/// @returns energy per unit depth [N]
inline double energy(const AreaPenalty& law, const RingMesh& mesh, const RingGeometry& ring) {
  const double difference = ring.area - mesh.rest_area;
  return 0.5 * law.modulus * difference * difference / mesh.rest_area;
}

[[gnu::always_inline]] inline void add_loads(const AreaPenalty& law, const RingMesh& mesh,
                                             RingGeometry& ring) {
  ring.pressure -= law.modulus * (ring.area - mesh.rest_area) / mesh.rest_area;
}

/// Adds the second derivatives, with g = dA/dX:
///
///   H += (k_A / A0) g g^T - pressure d2A/dX2
///
/// The second part joins neighbours alone and is indefinite; it acts on every node along the ring
/// as the pressure turns with the segments. Compression is of segments: this law has none.
inline void add_stiffness(const AreaPenalty& law, const RingMesh& mesh, const RingGeometry& ring,
                          Compression, RingStiffness& stiffness) {
  const std::size_t n = ring.nodes;
  const double half_pressure = -0.5 * law.modulus * (ring.area - mesh.rest_area) / mesh.rest_area;
  Tensor<2> turned;
  turned << 0, half_pressure, -half_pressure, 0;
  for (std::size_t i = 0; i < n; ++i) {
    stiffness.area_gradient[i] =
        0.5 * Vector<2>(ring.dy[i] + ring.dy[i + 1], -(ring.dx[i] + ring.dx[i + 1]));
    stiffness.block(i, 1) -= turned;
    stiffness.block(i, -1) += turned;
  }
  stiffness.area_coefficient += law.modulus / mesh.rest_area;
}

}  // namespace hemoscale::micro
