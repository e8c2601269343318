#pragma once

#include "macro/flow_state.hpp"
#include "micro/forcing.hpp"

namespace hemoscale::coupling {

/// What a point of the macro flow imposes on a micro model, and what is lost on the way.
struct ShearForcing {
  micro::Forcing<2> forcing;  // simple shear in the frame of the micro domain
  double shear_rate = 0;      // [1/s] sqrt(2 D:D) of the flow; L(0,1) of the forcing
  double flow_type = 0;       // [-] of macro/kinematics.hpp; 0 in simple shear and at rest
};

/// Simple shear u = (shear_rate y, 0) in the micro frame.
ShearForcing simple_shear(double shear_rate, double hematocrit);

/// The simple shear with the shear rate of the flow. A generalised-Newtonian law knows no more
/// of the flow than sqrt(2 D:D); flow_type tells how far the flow is from what is measured (1 in
/// pure straining, 0 in simple shear, -1 in solid rotation; in a plane flow without divergence 0
/// means simple shear, in space it is necessary only).
///
/// @param hematocrit  [-]
/// @throws NumericalError if the gradient is not finite
template <int dim>
ShearForcing to_forcing(const macro::FlowState<dim>& state, double hematocrit);

}  // namespace hemoscale::coupling
