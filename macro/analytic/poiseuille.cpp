#include "macro/analytic/poiseuille.hpp"

#include "macro/parameter_check.hpp"

namespace hemoscale::macro {

void check(const PlanePoiseuilleProfile& profile) {
  const char* owner = "plane Poiseuille flow";
  require_positive({owner, "height", profile.height, "m"}, "give the distance between the walls");
  require_finite({owner, "pressure_gradient", profile.pressure_gradient, "Pa/m"}, "give -dp/dx");
  require_positive({owner, "viscosity", profile.viscosity, "Pa s"}, "give the dynamic viscosity");
}

void check(const PipePoiseuilleProfile& profile) {
  const char* owner = "pipe Poiseuille flow";
  require_positive({owner, "radius", profile.radius, "m"}, "give the inner radius of the pipe");
  require_finite({owner, "pressure_gradient", profile.pressure_gradient, "Pa/m"}, "give -dp/dx");
  require_positive({owner, "viscosity", profile.viscosity, "Pa s"}, "give the dynamic viscosity");
}

ProfilePoint evaluate(const PlanePoiseuilleProfile& profile, double y, double /*t*/) {
  const double G = profile.pressure_gradient;
  const double half_curvature = G / (2 * profile.viscosity);
  return {half_curvature * y * (profile.height - y), half_curvature * (profile.height - 2 * y), G};
}

ProfilePoint evaluate(const PipePoiseuilleProfile& profile, double r, double /*t*/) {
  const double G = profile.pressure_gradient;
  const double quarter = G / (4 * profile.viscosity);
  return {quarter * (profile.radius - r) * (profile.radius + r), -2 * quarter * r, G};
}

}  // namespace hemoscale::macro
