#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "micro/linear/node_layout.hpp"
#include "micro/linear/sparse_matrix.hpp"

namespace hemoscale::micro {

/// Furthest entries of a matrix from its diagonal.
struct Bandwidth {
  std::size_t lower = 0;  // [-] below
  std::size_t upper = 0;  // [-] above
};

/// An order of the unknowns, and the bandwidth that a pattern has in it.
struct Ordering {
  std::vector<std::int32_t> place;  // [-] new number of each unknown
  Bandwidth bandwidth;
};

/// The unknowns as they are.
Ordering natural_order(const SparsePattern& pattern);

/// Numbers the unknowns column by column, in the way that gives the narrowest band: nodes by
///
///     s = x + (l0/2) y/H + (l0/2)^2 z/(H W),
///
/// x along one of the axes, as it is or rounded to whole spacings (which undoes the shaking of a
/// lattice), y and z across it within extents H and W. The tilt of half a spacing decides
/// among nodes of one column of a lattice by more than the round-off of their positions. Along a
/// periodic axis columns are taken in turn from either end (x is replaced by its distance from the
/// joined faces), which only doubles the bandwidth. A channel of n nodes across and range r of the
/// operator gets a bandwidth of about n r/l0 times the unknowns per node.
///
/// @throws ParameterError if the pattern is not whole or has not unknowns_per_node rows a node
template <int dim>
Ordering column_order(const SparsePattern& pattern, const NodeLayout<dim>& layout,
                      int unknowns_per_node);

}  // namespace hemoscale::micro
