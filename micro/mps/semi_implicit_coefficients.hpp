#pragma once

#include "micro/mps/semi_implicit_parts.hpp"

namespace hemoscale::micro {

/// Everything that depends on the present positions alone: neighbours, distances, number density,
/// weights of the operators. Gradients are computed where the options need them.
enum class StepMoment { first, moved };

template <int dim>
void compute_coefficients(const SemiImplicitSetting<dim>& setting, SemiImplicitState<dim>& state,
                          SemiImplicitWork<dim>& work, StepMoment moment);

}  // namespace hemoscale::micro
