#pragma once

#include <cstdint>
#include <vector>

#include "micro/immersed/cell.hpp"
#include "micro/mps/flow_domain.hpp"

namespace hemoscale::micro {

/// How the nodes of membranes take the place of plasma particles.
struct DirectInsertion {
  /// Plasma nearer to a membrane than this gives way [l0]; zero: that of 0.5, 0.6 .. 1.2 which
  /// leaves the number density nearest to n0. Nodes are particles like others and each is counted
  /// once, so the plasma has to make room for them: 0.9 l0 if they are 0.65 l0 apart.
  double clearance = 0;

  /// Sweeps in which the plasma around moves down the gradient of the number density, the nodes
  /// resting: without them the gaps of the removal remain.
  int sweeps = 40;
};

/// Membranes among the particles of a domain.
struct InsertedMembranes {
  FlowDomain<2> domain;
  std::int64_t first_identity = 0;  // of node 0 of cell 0; nodes and cells follow in order
  double clearance = 0;             // [l0] in the end
  std::size_t removed = 0;          // plasma particles
  double deviation = 0;  // [-] root mean square of n / n0 - 1 of nodes and plasma within 3 l0
};

/// Puts the nodes of the cells into a lattice domain: particles of the fluid, each cell a patch of
/// the kind `fluid`, with the velocity of the plasma that was there.
/// @param gradient_ratio, laplacian_ratio  kernel radii over the spacing
/// @throws ParameterError naming the cell if there is no plasma where it is put
InsertedMembranes insert_membranes(const FlowDomain<2>& domain, const std::vector<Cell>& cells,
                                   const DirectInsertion& insertion, double gradient_ratio,
                                   double laplacian_ratio);

}  // namespace hemoscale::micro
