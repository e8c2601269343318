#pragma once

#include "macro/analytic/pipe_flow.hpp"
#include "macro/analytic/plane_flow.hpp"

namespace hemoscale::macro {

// Fully developed pulsatile flow under the pressure gradient
//
//   G(t) = steady_gradient + oscillating_gradient cos(omega t)      with G = -dp/dx,
//
// after all transients. The oscillating part is that of Womersley (1955), the steady part that of
// Poiseuille. The amplitude is written with factors that do not cancel, so that it goes over into
// the quasi-steady parabola for alpha -> 0. Valid for 1e-3 <= alpha <= 1e4: tested over this range,
// and refused outside it, where the flow is quasi-steady or a plug to within 1e-4 or better.

/// Plane channel, alpha = (height / 2) sqrt(omega rho / mu), q = sqrt(i) alpha, and eta = -1 to 1
/// across the channel:
///
///   u = Re{ (G / (i rho omega)) [1 - cosh(q eta) / cosh(q)] exp(i omega t) }
struct WomersleyChannelProfile {
  double height = 0;                // [m] positive
  double steady_gradient = 0;       // [Pa/m]
  double oscillating_gradient = 0;  // [Pa/m] amplitude
  double angular_frequency = 0;     // [rad/s] omega, positive
  double viscosity = 0;             // [Pa s] mu, positive
  double density = 0;               // [kg/m^3] rho, positive
};

/// Pipe, alpha = radius sqrt(omega rho / mu), q = sqrt(i) alpha, xi = r / radius:
///
///   u = Re{ (G / (i rho omega)) [1 - I_0(q xi) / I_0(q)] exp(i omega t) }
///
/// with I_0(sqrt(i) x) = J_0(i^(3/2) x); see bessel.hpp for its evaluation.
struct WomersleyPipeProfile {
  double radius = 0;                // [m] positive
  double steady_gradient = 0;       // [Pa/m]
  double oscillating_gradient = 0;  // [Pa/m] amplitude
  double angular_frequency = 0;     // [rad/s] omega, positive
  double viscosity = 0;             // [Pa s] mu, positive
  double density = 0;               // [kg/m^3] rho, positive
};

/// Womersley number, half-height or radius over the thickness of the oscillating layer [-].
double womersley_number(const WomersleyChannelProfile& profile);
double womersley_number(const WomersleyPipeProfile& profile);

void check(const WomersleyChannelProfile& profile);
void check(const WomersleyPipeProfile& profile);

/// @param y  0 to height [m]
/// @param t  any time [s]
ProfilePoint evaluate(const WomersleyChannelProfile& profile, double y, double t);

/// @param r  0 to radius [m]
/// @param t  any time [s]
ProfilePoint evaluate(const WomersleyPipeProfile& profile, double r, double t);

template <int dim>
using WomersleyChannel = PlaneFlow<dim, WomersleyChannelProfile>;
using WomersleyPipe = PipeFlow<WomersleyPipeProfile>;

}  // namespace hemoscale::macro
