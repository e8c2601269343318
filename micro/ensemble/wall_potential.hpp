#pragma once

namespace hemoscale::micro {

/// Soft repulsion of a node at the distance h from a wall, per unit depth:
///
///   U = (k/2) (range - h)^2 for h < range, else 0    [N],     F = k (range - h) away from the wall
///
/// It also pushes back nodes that have passed the wall (h < 0).
struct WallPotential {
  double stiffness = 0;  // [Pa]
  double range = 0;      // [m]

  double force(double h) const { return h < range ? stiffness * (range - h) : 0; }  // [N/m]
  double energy(double h) const {                                                   // [N]
    return h < range ? 0.5 * stiffness * (range - h) * (range - h) : 0;
  }
};

}  // namespace hemoscale::micro
