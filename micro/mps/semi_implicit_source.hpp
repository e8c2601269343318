#pragma once

#include "micro/mps/semi_implicit_parts.hpp"

namespace hemoscale::micro {

/// Right-hand side of lap p = source at the moved positions [Pa/m^2], for particles whose pressure
/// is solved for. With n the number density, k the beginning of the step and * the moved particles:
///
///   pnd:         -gamma rho / dt^2 (n* - n0) / n0
///   divergence:  rho / dt div u*
///   hs-ecs:      -rho / (dt n0) (dn/dt)* - rho / dt ( |a| (dn/dt)^k / n0 + |b| a / dt ),
///                a = (n^k - n0) / n0,  b = dt (dn/dt)^k / n0
///
/// (Koshizuka and Oka 1996; Khayyer and Gotoh 2009, 2011).
template <int dim>
void pressure_source(const SemiImplicitSetting<dim>& setting, const SemiImplicitState<dim>& state,
                     SemiImplicitWork<dim>& work, double dt);

}  // namespace hemoscale::micro
