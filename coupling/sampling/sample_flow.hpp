#pragma once

#include <vector>

#include "macro/flow_field.hpp"

namespace hemoscale::coupling {

/// The flow at every point, in their order. Collective over the ranks of the field.
///
/// @param points  [m]
/// @param time    [s]
/// @throws CaseError with one fault for each point outside the field (key sampling.points, number
///         and coordinates of the point); NumericalError if a velocity gradient is not finite
template <int dim>
std::vector<macro::FlowState<dim>> sample_flow(const macro::FlowField<dim>& field,
                                               const std::vector<macro::Vector<dim>>& points,
                                               double time);

}  // namespace hemoscale::coupling
