#pragma once

#include <span>

#include "micro/ensemble/observables/node_forces.hpp"
#include "micro/ensemble/state.hpp"

namespace hemoscale::micro {

/// Rate of a mean square distance from the axis, by what causes it [m^2/s]; negative: contracts.
struct MomentRate {
  double flow = 0;  // lateral component of the given flow; zero in a straight channel
  double membrane = 0;
  double attraction = 0;
  double repulsion = 0;
  double other_kinds = 0;
  double wall = 0;
  double lift = 0;

  double total() const {
    return flow + membrane + attraction + repulsion + other_kinds + wall + lift;
  }
};

/// With isotropic drag zeta and no inertia every node has zeta (v - u) = F, hence
///
///   d<(y - H/2)^2>/dt = 2 <(y - H/2) u_y> + (2/zeta) <(y - H/2) F_y>                       (nodes)
///   d<(Y - H/2)^2>/dt = 2 <(Y - H/2) U_y> + (2/zeta) <(Y - H/2) mean F_y>                  (cells)
///
/// exactly, and part by part as F is a sum of parts. The first mean is over nodes; it changes with
/// the shapes of the cells too, by the membranes. The second is over cells, Y, U_y and the mean
/// force being means over the nodes of a cell: membranes cannot contribute. Pairs contract the
/// distribution only if their virial is attractive; no shape or stiffness can. It does not hold for
/// anisotropic drag, nor with inertia before the transient is over.
struct MomentBalance {
  MomentRate nodes, cells;
  double node_moment = 0;  // [m^2] <(y - H/2)^2>
  double cell_moment = 0;  // [m^2] <(Y - H/2)^2>
};

/// @param flow_y  given flow across the channel at the nodes [m/s]; empty: zero
/// @param height  [m] of the channel
/// @param node_drag  [Pa s] zeta
MomentBalance moment_balance(const EnsembleState& state, std::span<const double> flow_y,
                             const PairParts& pairs, const NodeForces& forces, double height,
                             double node_drag);

}  // namespace hemoscale::micro
