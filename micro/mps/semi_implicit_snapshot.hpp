#pragma once

#include "micro/model.hpp"
#include "micro/mps/semi_implicit_parts.hpp"

namespace hemoscale::micro {

/// Everything of the state, under names that begin with "semi_implicit.".
template <int dim>
Snapshot to_snapshot(const SemiImplicitState<dim>& state);

/// @throws ParameterError if the snapshot does not hold such a state of this dimension
template <int dim>
SemiImplicitState<dim> from_snapshot(const Snapshot& snapshot);

}  // namespace hemoscale::micro
