#pragma once

namespace hemoscale::micro {

/// Drift of a deformable cell away from the walls of a plane channel, after the lift of vesicles
/// and droplets near one wall in shear [Olla 1997; Coupier, Kaoui, Podgorski and Misbah 2008]:
///
///   dy/dt = k [1/y^2 - 1/(height - y)^2],   k = U gamma_wall R^3      [m/s]
///
/// for the centre of a cell at the height y above the lower wall. U is near 0.1 for red cells;
/// gamma_wall is the shear rate at the wall, R the radius of a circle with the perimeter of the
/// cell. From rest at the wall, y = (3 k t)^(1/3).
struct WallLift {
  double coefficient = 0;  // [m^3/s] k

  /// @pre 0 < y < height [m]
  double velocity(double y, double height) const {
    const double above = height - y;
    return coefficient * (1 / (y * y) - 1 / (above * above));
  }
};

}  // namespace hemoscale::micro
