#pragma once

#include "macro/analytic/plane_flow.hpp"

namespace hemoscale::macro {

// Both flows start from rest at t = 0 and are exact to rounding at every time: while the boundary
// layers have not met (nu t < 0.1 height^2), sums over images with error functions are used, later
// the eigenfunction series (Carslaw and Jaeger 1959, chapters 3 and 12; heat conduction in a slab
// is the same equation). Either needs a handful of terms in its range.

/// Fluid between resting walls, driven from t = 0 by a constant pressure gradient:
///
///   u = G y (h - y) / (2 mu)
///       - (4 G h^2 / (mu pi^3)) sum over odd k of sin(k pi y / h) exp(-k^2 pi^2 nu t / h^2) / k^3
///
/// with h the height and nu = viscosity / density. At rest without pressure gradient for t < 0.
struct StartUpPoiseuilleProfile {
  double height = 0;             // [m] positive
  double pressure_gradient = 0;  // [Pa/m] G = -dp/dx, positive for flow along +x
  double viscosity = 0;          // [Pa s] mu, positive
  double density = 0;            // [kg/m^3] positive
};

/// Fluid between the resting wall y = 0 and the wall y = height, which moves with U from t = 0:
///
///   u = U y / h + (2 U / pi) sum_{k >= 1} ((-1)^k / k) sin(k pi y / h) exp(-k^2 pi^2 nu t / h^2)
///
/// At rest for t <= 0, including the fluid at the moving wall.
struct StartUpCouetteProfile {
  double height = 0;         // [m] positive
  double wall_velocity = 0;  // [m/s] U
  double viscosity = 0;      // [Pa s] positive
  double density = 0;        // [kg/m^3] positive
};

void check(const StartUpPoiseuilleProfile& profile);
void check(const StartUpCouetteProfile& profile);

/// @param y  0 to height [m]
/// @param t  any time [s]
ProfilePoint evaluate(const StartUpPoiseuilleProfile& profile, double y, double t);
ProfilePoint evaluate(const StartUpCouetteProfile& profile, double y, double t);

template <int dim>
using StartUpPoiseuille = PlaneFlow<dim, StartUpPoiseuilleProfile>;
template <int dim>
using StartUpCouette = PlaneFlow<dim, StartUpCouetteProfile>;

}  // namespace hemoscale::macro
