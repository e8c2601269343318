#pragma once

#include "micro/cells/bending.hpp"
#include "micro/cells/ring_mesh.hpp"

namespace hemoscale::micro {

/// Bending by tangents of half angles, per unit depth: the form of the paper's membrane
/// [Tsubota2006, section 3.1, "angle between the neighboring elements"; Tsubota, Wada and Yamaguchi
/// 2006]:
///
///   E = sum_i (k_b_i / 2) tan^2((theta_i - theta0_i) / 2),   k_b_i = 4 kappa / l0_i        [N]
///
/// The mapping of k_b makes the continuum limit (kappa/2) int (c - c0)^2 ds, reached with second
/// order. Differs from the turning-angle law at large angles only, where it stiffens and diverges
/// at pi.
struct HalfAngleBending {
  double modulus = 0;  // [J] kappa
};

/// tan((theta - theta0)/2) from the tangents of the halves.
[[gnu::always_inline]] inline double half_tangent_of_difference(double t, double natural) {
  return (t - natural) / (1 + t * natural);
}

/// @returns energy per unit depth [N]
inline double energy(const HalfAngleBending& law, const RingMesh& mesh, RingGeometry& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.nodes; ++i) {
    const double t = half_tangent_of_difference(ring.half_tangent[i], mesh.natural_half_tangent[i]);
    sum += t * t / mesh.node_length[i];
  }
  return 2 * law.modulus * sum;
}

/// Writes M_i = dE/dtheta_i = (k_b / 2) t (1 + t^2) to ring.moment [N], closed.
[[gnu::always_inline]] inline void set_moments(const HalfAngleBending& law, const RingMesh& mesh,
                                               RingGeometry& ring) {
  double* const moment = ring.moment.data();
  const double* const half_tangent = ring.half_tangent.data();
  const double* const natural = mesh.natural_half_tangent.data();
  const double* const node_length = mesh.node_length.data();
  const std::size_t n = ring.nodes;
  const double half_stiffness = 2 * law.modulus;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = half_tangent_of_difference(half_tangent[i], natural[i]);
    moment[i] = half_stiffness / node_length[i] * t * (1 + t * t);
  }
  moment[n] = moment[0];
}

/// Adds the pulls of the segments.
[[gnu::always_inline]] inline void add_loads(const HalfAngleBending& law, const RingMesh& mesh,
                                             RingGeometry& ring) {
  set_moments(law, mesh, ring);
  add_moment_pulls(ring);
}

/// Adds the second derivatives: dM/dtheta = (k_b / 4) (1 + t^2) (1 + 3 t^2). Bending has no
/// tension: `Compression` does not touch it.
inline void add_stiffness(const HalfAngleBending& law, const RingMesh& mesh, RingGeometry& ring,
                          Compression, RingStiffness& stiffness) {
  set_moments(law, mesh, ring);
  const auto slope = [&](std::size_t i) {
    const double t = half_tangent_of_difference(ring.half_tangent[i], mesh.natural_half_tangent[i]);
    return law.modulus / mesh.node_length[i] * (1 + t * t) * (1 + 3 * t * t);
  };
  add_moment_stiffness(ring, slope, stiffness);
}

}  // namespace hemoscale::micro
