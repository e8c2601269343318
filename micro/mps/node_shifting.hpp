#pragma once

#include <vector>

#include "micro/mps/stage_problem.hpp"

namespace hemoscale::micro {

/// Displacements that drive nodes from crowded to empty places, down the gradient of a
/// concentration (Lind, Xu, Stansby and Rogers 2012) with the kernel (1 - r / R)^3, R = 1.5
/// spacings:
///
///   dx_i = - A l0 sum_j (1 - r_ij / R)^2 (r_j - r_i) / r_ij,
///
/// A such that a node between others of a lattice that has moved by d returns by about 0.3 d. The
/// kernel is so short that a wall, one row of nodes, weighs as much as the row of fluid on the
/// other side. Boundaries do not move. Steps are no longer than `largest`.
///
/// @param largest  [m]
template <int dim>
std::vector<Vector<dim>> shifting_displacements(const NodeGeometry<dim>& nodes, double largest);

}  // namespace hemoscale::micro
