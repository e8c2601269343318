#pragma once

#include "macro/analytic/pipe_flow.hpp"
#include "macro/analytic/plane_flow.hpp"

namespace hemoscale::macro {

/// u = G y (height - y) / (2 mu) between resting walls.
struct PlanePoiseuilleProfile {
  double height = 0;             // [m] positive
  double pressure_gradient = 0;  // [Pa/m] G = -dp/dx, positive for flow along +x
  double viscosity = 0;          // [Pa s] mu, positive
};

/// u = G (radius^2 - r^2) / (4 mu) in a resting pipe.
struct PipePoiseuilleProfile {
  double radius = 0;             // [m] positive
  double pressure_gradient = 0;  // [Pa/m] G = -dp/dx, positive for flow along +x
  double viscosity = 0;          // [Pa s] mu, positive
};

void check(const PlanePoiseuilleProfile& profile);
void check(const PipePoiseuilleProfile& profile);

/// @param y  0 to height [m]; the time is not used
ProfilePoint evaluate(const PlanePoiseuilleProfile& profile, double y, double t);

/// @param r  0 to radius [m]; the time is not used
ProfilePoint evaluate(const PipePoiseuilleProfile& profile, double r, double t);

template <int dim>
using PlanePoiseuille = PlaneFlow<dim, PlanePoiseuilleProfile>;
using PipePoiseuille = PipeFlow<PipePoiseuilleProfile>;

}  // namespace hemoscale::macro
