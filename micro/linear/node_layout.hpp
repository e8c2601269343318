#pragma once

#include <span>

#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Where the unknowns of a system live: what orderings and coarse spaces need to know of particles.
/// Every node carries the same number of unknowns, one after another.
template <int dim>
struct NodeLayout {
  std::span<const Vector<dim>> positions;    // [m] of the nodes, in the order of their unknowns
  double spacing = 0;                        // [m] typical distance of neighbours, l0
  Vector<dim> period = Vector<dim>::Zero();  // [m] of axes whose ends are joined; 0 of open ones
  double slide = 0;                          // [m] along the first axis of the image above the
                                             // second period (Lees and Edwards 1972)
};

}  // namespace hemoscale::micro
