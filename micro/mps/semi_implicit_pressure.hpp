#pragma once

#include "micro/mps/semi_implicit_parts.hpp"

namespace hemoscale::micro {

/// Which particles take part in pressure sums, and of which the pressure is unknown: dummies and
/// inlet particles behind the first layer have none; outlets, free surfaces, walls beside an
/// outlet zone and walls that no fluid touches have a given one.
template <int dim>
void assign_pressure_roles(const SemiImplicitSetting<dim>& setting,
                           const SemiImplicitState<dim>& state, SemiImplicitWork<dim>& work);

/// Solves lap p = source, or with the incremental coupling that for the change of p, and corrects
/// the free particles,
///
///   u = u* - dt grad p / rho,   r = r* - dt^2 grad p / rho.
///
/// @pre coefficients, roles and source at the moved positions
/// @throws NumericalError if a particle has no neighbour with a pressure, or the solver fails
template <int dim>
void project(const SemiImplicitSetting<dim>& setting, SemiImplicitState<dim>& state,
             SemiImplicitWork<dim>& work, double dt);

}  // namespace hemoscale::micro
