#pragma once

#include "micro/cells/ring_geometry.hpp"
#include "micro/cells/ring_mesh.hpp"

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

}  // namespace hemoscale::micro
