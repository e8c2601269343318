#pragma once

#include <span>
#include <vector>

#include "micro/ensemble/box.hpp"
#include "micro/ensemble/observables/node_forces.hpp"
#include "micro/ensemble/observables/step_forces.hpp"
#include "micro/ensemble/state.hpp"

namespace hemoscale::micro {

/// Contact forces on the nodes of every kind by cells of all other kinds [N/m]:
///
///   F_i = sum over nodes j of other kinds within the cutoff of force_over_distance(d.d) d,
///   d = x_i - x_j
///
/// images included; over all kinds they sum to zero. Cost proportional to all nodes.
/// @param kinds  at the same time, in the same coordinates, by no more than one period apart
std::vector<ForceArrays> cross_forces(std::span<const EnsembleState> kinds, const Box& box,
                                      const PairLaw& law);

/// Takes the forces between kinds out of those of the membranes, of which step_forces makes them a
/// part, and puts them where they belong.
/// @param steps  of the kinds, in their order
void separate_other_kinds(std::span<StepForces> steps, std::span<const EnsembleState> kinds,
                          const Box& box, const PairLaw& law);

}  // namespace hemoscale::micro
