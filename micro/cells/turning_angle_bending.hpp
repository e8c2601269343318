#pragma once

#include "micro/cells/bending.hpp"
#include "micro/cells/ring_mesh.hpp"

namespace hemoscale::micro {

/// Bending by turning angles, per unit depth:
///
///   E = (kappa / 2) sum_i (theta_i - theta0_i)^2 / l0_i        [N]
///
/// Converges to the continuum (kappa/2) int (c - c0)^2 ds with second order in the node spacing.
/// The angle is that of atan2(cross, dot) of neighbouring segments, in (-pi, pi): it sees the sign
/// of the curvature. Invalid where two segments fold back on each other.
struct TurningAngleBending {
  double modulus = 0;  // [J] kappa
};

/// Inverse tangent for |t| <= tan(pi/8), relative error 4e-17 before rounding: interpolation of
/// atan(sqrt z)/sqrt z at eleven Chebyshev points of 0 <= z <= tan^2(pi/8). A polynomial alone, so
/// that loops over it become vector instructions, which those over std::atan do not.
[[gnu::always_inline]] inline double small_arctangent(double t) {
  const double z = t * t;
  double p = 0.021133752033748364;
  p = p * z - 0.04347919839046537;
  p = p * z + 0.0568830340363325;
  p = p * z - 0.066402251735395;
  p = p * z + 0.07689952488233016;
  p = p * z - 0.09090773003240828;
  p = p * z + 0.11111106177375227;
  p = p * z - 0.14285714180900647;
  p = p * z + 0.19999999998854168;
  p = p * z - 0.33333333333328435;
  // The leading term is added last and exactly: small angles keep full relative accuracy.
  return t + t * (z * p);
}

/// Writes the turning angle at every node to `angle` [rad].
[[gnu::always_inline]] inline void turning_angles(const RingGeometry& ring, double* angle) {
  constexpr double tan_pi_8 = 0.41421356237309503;
  const std::size_t n = ring.nodes;
  const double* const half_tangent = ring.half_tangent.data();
  std::size_t large = 0;
  for (std::size_t i = 0; i < n; ++i) {
    angle[i] = 2 * small_arctangent(half_tangent[i]);
    large += std::abs(half_tangent[i]) > tan_pi_8 ? 1U : 0U;
  }
  if (large == 0) {
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {  // beyond 45 degrees the polynomial does not hold
    if (std::abs(half_tangent[i]) > tan_pi_8) {
      angle[i] = 2 * std::atan(half_tangent[i]);
    }
  }
}

/// @returns energy per unit depth [N]
inline double energy(const TurningAngleBending& law, const RingMesh& mesh, RingGeometry& ring) {
  turning_angles(ring, ring.moment.data());
  double sum = 0;
  for (std::size_t i = 0; i < ring.nodes; ++i) {
    const double difference = ring.moment[i] - mesh.natural_angle[i];
    sum += difference * difference / mesh.node_length[i];
  }
  return 0.5 * law.modulus * sum;
}

/// Writes M_i = dE/dtheta_i to ring.moment [N], closed.
[[gnu::always_inline]] inline void set_moments(const TurningAngleBending& law, const RingMesh& mesh,
                                               RingGeometry& ring) {
  double* const moment = ring.moment.data();
  turning_angles(ring, moment);
  const double* const natural = mesh.natural_angle.data();
  const double* const node_length = mesh.node_length.data();
  const std::size_t n = ring.nodes;
  const double modulus = law.modulus;
  for (std::size_t i = 0; i < n; ++i) {
    moment[i] = modulus * (moment[i] - natural[i]) / node_length[i];
  }
  moment[n] = moment[0];
}

/// Adds the pulls of the segments.
[[gnu::always_inline]] inline void add_loads(const TurningAngleBending& law, const RingMesh& mesh,
                                             RingGeometry& ring) {
  set_moments(law, mesh, ring);
  add_moment_pulls(ring);
}

/// Adds the second derivatives: dM/dtheta = kappa / l0. Bending has no tension: `Compression` does
/// not touch it.
inline void add_stiffness(const TurningAngleBending& law, const RingMesh& mesh, RingGeometry& ring,
                          Compression, RingStiffness& stiffness) {
  set_moments(law, mesh, ring);
  add_moment_stiffness(
      ring, [&](std::size_t i) { return law.modulus / mesh.node_length[i]; }, stiffness);
}

}  // namespace hemoscale::micro
