#pragma once

#include "micro/mps/semi_implicit_parts.hpp"

namespace hemoscale::micro {

/// Velocities without the new pressure,
///
///   u* = u + dt (nu lap u + f - grad p / rho),
///
/// the last term with the incremental coupling alone; lap u of u or of u*, explicit or implicit.
/// Walls, inlets and outlets get their velocities at the end of the step.
/// @pre coefficients at the present positions
template <int dim>
void predict(const SemiImplicitSetting<dim>& setting, SemiImplicitState<dim>& state,
             SemiImplicitWork<dim>& work, double dt);

}  // namespace hemoscale::micro
