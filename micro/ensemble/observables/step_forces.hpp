#pragma once

#include <span>
#include <vector>

#include "micro/ensemble/box.hpp"
#include "micro/ensemble/flow/given_flow.hpp"
#include "micro/ensemble/migration/lateral_migration.hpp"
#include "micro/ensemble/observables/node_forces.hpp"
#include "micro/ensemble/state.hpp"
#include "micro/ensemble/wall_potential.hpp"

namespace hemoscale::micro {

/// What moved the nodes of one kind in a step.
struct StepForces {
  std::vector<double> velocity_x, velocity_y;  // [m/s]
  ForceArrays membrane;                        // [N/m] all that is neither contact nor wall
  ForceArrays wall;                            // [N/m]
  ForceArrays other_kinds;                     // [N/m] empty before separate_other_kinds
  ForceArrays lift;                            // [N/m] drag times drift; empty without laws of it
};

/// What joins velocity to force beside an isotropic drag. With w = v - u - drift, n the normal of
/// the chord between both neighbours of a node:
///
///   F = zeta [w + (normal_ratio - 1) (w.n) n] + momentum |w| w
struct StepDrag {
  double normal_ratio = 1;               // [-] drag across the membrane over that along it
  double momentum = 0;                   // [kg/m^2]
  std::span<const double> drift_y = {};  // [m/s] of every node by laws of migration; empty: none
};

/// Mean forces of a step, from the displacements d of the nodes: total = zeta (d/dt - u), or what
/// StepDrag says, from which contacts within the kind and walls are subtracted. With mass,
/// `membrane` holds the force of inertia -m dv/dt too.
///
/// After an implicit step the stiff forces at the positions themselves are not those that moved the
/// nodes: errors of the positions of 1e-11 m change them as much as the flow does. With several
/// kinds, contacts between them are part of `membrane` until separate_other_kinds takes them out.
///
/// @param before, after  of one kind, cells in the same order and unwrapped alike
/// @param box   plane channel with walls, periodic along x
/// @param flow  at the time of `after`
StepForces step_forces(const EnsembleState& before, const EnsembleState& after, double time_step,
                       const Box& box, const GivenFlow& flow, double node_drag, const PairLaw& law,
                       const WallPotential& wall, const StepDrag& more = {});

/// Velocities of every node by laws of lateral migration in a step [m/s], the same for all nodes of
/// a cell, see micro/ensemble/migration.
/// @param before  at the beginning of the step; its cells are numbered from 0
std::vector<double> drift_velocities(const EnsembleState& before, const LateralMigration& migration,
                                     const Box& box, const GivenFlow& flow, double time_step);

/// Moves every cell by whole periods along x so that its middle lies in [0, length).
/// @param companion  of the same cells, moved alike
void bring_home(const Box& box, EnsembleState& state, EnsembleState* companion = nullptr);

}  // namespace hemoscale::micro
