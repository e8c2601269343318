#pragma once

#include <span>
#include <vector>

#include "micro/ensemble/observables/cell_shape.hpp"
#include "micro/ensemble/observables/node_forces.hpp"
#include "micro/ensemble/observables/slices.hpp"
#include "micro/ensemble/state.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Stress that the cells transmit through planes y = c of a channel, the mean over each bin [Pa]:
///
///   Sigma_iy(c) = (1/L) sum over nodes below c of F_i
///
/// F is the sum of membrane and contact forces on a node, without walls. It is the method of planes
/// in the form of [Irving and Kirkwood 1950]: forces within what lies below the plane cancel, so
/// that the sum is what the cells above exert on those below. Exact for every plane, while a
/// stresslet put at the centre of its cell gives the right mean and the wrong profile. The mean
/// over the channel is Batchelor's stress, -(1/V) sum F_i y. Tension is positive.
/// @param force  component i on all nodes [N/m]
/// @param length  of the channel [m]
std::vector<double> plane_stress(const EnsembleState& state, std::span<const double> force,
                                 double length, const LateralBins& bins);

/// Stresslet of each cell by its membrane, -sum F (x) (x - centre) [N]: symmetric, as membranes
/// exert no torque. Over the area of the cell it is the stress of its membrane averaged over it.
std::vector<Tensor<2>> membrane_stresslets(const EnsembleState& state,
                                           std::span<const CellShape> shapes,
                                           const ForceView& membrane);

}  // namespace hemoscale::micro
