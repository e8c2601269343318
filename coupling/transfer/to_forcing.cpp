#include "coupling/transfer/to_forcing.hpp"

#include "coupling/error.hpp"
#include "macro/kinematics.hpp"

namespace hemoscale::coupling {

ShearForcing simple_shear(double shear_rate, double hematocrit) {
  ShearForcing result;
  result.shear_rate = shear_rate;
  result.forcing.velocity_gradient(0, 1) = shear_rate;
  result.forcing.hematocrit = hematocrit;
  return result;
}

template <int dim>
ShearForcing to_forcing(const macro::FlowState<dim>& state, double hematocrit) {
  if (!state.velocity_gradient.allFinite()) {
    throw NumericalError(
        "velocity gradient of the macro flow is not finite; the macro flow has failed: reduce its "
        "time step or relax it more");
  }
  ShearForcing result = simple_shear(macro::shear_rate<dim>(state.velocity_gradient), hematocrit);
  result.flow_type = macro::flow_type<dim>(state.velocity_gradient).value_or(0);
  return result;
}

template ShearForcing to_forcing<2>(const macro::FlowState<2>&, double);
template ShearForcing to_forcing<3>(const macro::FlowState<3>&, double);

}  // namespace hemoscale::coupling
