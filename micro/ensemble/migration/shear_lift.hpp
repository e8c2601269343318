#pragma once

#include <algorithm>
#include <cmath>

namespace hemoscale::micro {

/// Drift of a deformable cell towards the axis of a plane channel by the similarity law of vesicles
/// in Poiseuille flow [Coupier, Kaoui, Podgorski and Misbah 2008] with exponent 1:
///
///   dy/dt = +- xi |gamma(y)| R^2 / d     [m/s], away from the nearest wall
///
/// for the centre of a cell at the distance d from that wall, where the given flow has the shear
/// rate gamma. Resolved two-dimensional cells of reduced area 0.7 without contrast of viscosity
/// have xi = 0.153 +- 0.007; R is the radius of a circle with the perimeter of the cell.
struct ShearLift {
  double coefficient = 0;  // [-] xi
  double radius = 0;       // [m] R

  /// @param shear_rate  [1/s] of either sign
  /// @pre 0 < y < height [m]
  double velocity(double y, double height, double shear_rate) const {
    const double distance = std::min(y, height - y);
    const double direction = 2 * y < height ? 1 : -1;
    return direction * coefficient * std::abs(shear_rate) * radius * radius / distance;
  }
};

}  // namespace hemoscale::micro
