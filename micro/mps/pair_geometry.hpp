#pragma once

#include <vector>

#include "micro/particles/neighbour_table.hpp"
#include "micro/particles/periodic_box.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Where the neighbours of each particle are now, entry by entry of a neighbour table: computed
/// once for all the sums over the same positions.
template <int dim>
struct PairGeometry {
  std::vector<Vector<dim>> separations;  // [m] r_j - r_i, nearest image
  std::vector<double> distances;         // [m]
};

template <int dim>
void measure_pairs(const std::vector<Vector<dim>>& positions, const PeriodicBox<dim>& box,
                   const NeighbourTable& table, PairGeometry<dim>& pairs);

}  // namespace hemoscale::micro
