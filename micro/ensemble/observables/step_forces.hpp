#pragma once

#include <vector>

#include "micro/ensemble/box.hpp"
#include "micro/ensemble/flow/given_flow.hpp"
#include "micro/ensemble/observables/node_forces.hpp"
#include "micro/ensemble/state.hpp"
#include "micro/ensemble/wall_potential.hpp"

namespace hemoscale::micro {

/// What moved the nodes of one kind in a step.
struct StepForces {
  std::vector<double> velocity_x, velocity_y;  // [m/s]
  ForceArrays membrane;                        // [N/m] all that is neither contact nor wall
  ForceArrays wall;                            // [N/m]
};

/// Mean forces of a step, from the displacements d of the nodes: total = zeta (d/dt - u), from
/// which contacts within the kind and walls are subtracted.
///
/// After an implicit step the stiff forces at the positions themselves are not those that moved the
/// nodes: errors of the positions of 1e-11 m change them as much as the flow does. With several
/// kinds, contacts between them are part of `membrane`.
///
/// @param before, after  of one kind, cells in the same order and unwrapped alike
/// @param box   plane channel with walls, periodic along x
/// @param flow  at the time of `after`
StepForces step_forces(const EnsembleState& before, const EnsembleState& after, double time_step,
                       const Box& box, const GivenFlow& flow, double node_drag, const PairLaw& law,
                       const WallPotential& wall);

/// Moves every cell by whole periods along x so that its middle lies in [0, length).
/// @param companion  of the same cells, moved alike
void bring_home(const Box& box, EnsembleState& state, EnsembleState* companion = nullptr);

}  // namespace hemoscale::micro
