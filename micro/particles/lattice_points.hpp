#pragma once

#include <cmath>
#include <vector>

#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Points of a square (cubic) lattice of unit spacing around the origin, nearer than `radius`; the
/// origin itself is not among them.
template <int dim>
std::vector<Vector<dim>> lattice_points(double radius) {
  const int reach = static_cast<int>(std::ceil(radius));
  const int depth = dim == 3 ? reach : 0;
  std::vector<Vector<dim>> points;
  for (int z = -depth; z <= depth; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        Vector<dim> r;
        r[0] = x;
        r[1] = y;
        if constexpr (dim == 3) r[2] = z;
        if (r.norm() > 0 && r.norm() < radius) points.push_back(r);
      }
    }
  }
  return points;
}

}  // namespace hemoscale::micro
