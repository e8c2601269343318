#pragma once

namespace hemoscale::micro {

/// Force between two nodes of different cells, per unit depth, for d = x_i - x_j and s = d.d:
///
///   F_i = A (rc^2 - s)^2 (r0^2 - s) d  for s < rc^2, times `attraction` where s > r0^2, else 0
///   [N/m]
///
/// A polynomial of the squared distance: no root, bounded stiffness, once continuously
/// differentiable at rc, a kink at r0. With w = rc^2 - s and b = rc^2 - r0^2 its energy is
///
///   U = attraction (A/2) (w^4/4 - b w^3/3)                       for w < b (attractive branch)
///   U = (A/2) (w^4/4 - b w^3/3) + (1 - attraction) A b^4/24      for w > b [N]
///
/// The scale follows from the stiffness k = -dF/dr at r0 on the repulsive side: k = 2 A r0^2 b^2.
struct PairPotential {
  double scale = 0;           // [N/m^7] A; for s in m^2 and d in m
  double rest_squared = 0;    // [m^2] r0^2
  double cutoff_squared = 0;  // [m^2] rc^2
  double attraction = 0;      // [-]

  /// F_i = force_over_distance(s) * d; exactly zero from the cutoff on.
  double force_over_distance(double s) const {
    const double inside = cutoff_squared - s;
    const double w = inside > 0 ? inside : 0;
    const double repulsion = rest_squared - s;
    return scale * (w * w) * repulsion * (repulsion > 0 ? 1.0 : attraction);
  }

  /// Energy of the pair per unit depth [N].
  double energy(double s) const {
    const double w = cutoff_squared - s;
    if (w <= 0) {
      return 0;
    }
    const double b = cutoff_squared - rest_squared;
    const double branch = 0.5 * scale * w * w * w * (0.25 * w - b / 3);
    return w < b ? attraction * branch : branch + (1 - attraction) * scale * b * b * b * b / 24;
  }

  /// d^2 U / dr^2 [Pa].
  double curvature(double s) const {
    if (s >= cutoff_squared) {
      return 0;
    }
    const double w = cutoff_squared - s;
    const double repulsion = rest_squared - s;
    const double value = scale * (4 * s * w * repulsion + 2 * s * w * w - w * w * repulsion);
    return repulsion > 0 ? value : attraction * value;
  }
};

/// @param stiffness  -dF/dr at the rest distance [Pa]
/// @pre 0 < rest_distance < cutoff [m]
inline PairPotential make_pair_potential(double stiffness, double rest_distance, double cutoff,
                                         double attraction) {
  const double r = rest_distance * rest_distance;
  const double c = cutoff * cutoff;
  return {.scale = stiffness / (2 * r * (c - r) * (c - r)),
          .rest_squared = r,
          .cutoff_squared = c,
          .attraction = attraction};
}

}  // namespace hemoscale::micro
