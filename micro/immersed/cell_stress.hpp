#pragma once

#include "micro/immersed/boundary_integral.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// What one cell adds to the stress of the suspension, times the area of suspension that it has for
/// itself, per unit depth [N] [Batchelor1970; Kennedy, Pozrikidis and Skalak 1994]:
///
///   S = - sum_i F_i x_i + mu (lambda - 1) closed int (u n + n u) ds,
///
/// F the elastic forces on the fluid, symmetric if they exert no torque. The intrinsic viscosity in
/// the shear u = G y is S_xy / (mu G A), the normal stress difference S_xx - S_yy.
/// @param viscosity  mu of the fluid outside [Pa s]
Tensor<2> cell_stress(const RingSource& cell, double viscosity);

}  // namespace hemoscale::micro
