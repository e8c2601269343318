#pragma once

#include "micro/mps/semi_implicit_parts.hpp"

namespace hemoscale::micro {

/// Shifts the free particles and lets their velocities (with the incremental coupling also their
/// pressures) follow; corrected gradients, over all neighbours.
template <int dim>
void shift_particles(const SemiImplicitSetting<dim>& setting, SemiImplicitState<dim>& state,
                     SemiImplicitWork<dim>& work);

}  // namespace hemoscale::micro
