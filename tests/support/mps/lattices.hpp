#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "micro/mps/pair_geometry.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::micro::test {

/// Points with their neighbours.
template <int dim>
struct Cloud {
  PeriodicBox<dim> box;
  std::vector<Vector<dim>> positions;
  NeighbourTable table;
  PairGeometry<dim> pairs;

  void search(double radius) {
    table.build(positions, box, radius);
    measure_pairs(positions, box, table, pairs);
  }
};

/// Points at the centres of the cells of a box, displaced evenly by up to `jitter` spacings.
template <int dim>
Cloud<dim> lattice_cloud(const PeriodicBox<dim>& box, double spacing, double jitter,
                         std::uint64_t seed = 1) {
  Cloud<dim> cloud;
  cloud.box = box;
  std::size_t total = 1;
  Eigen::Matrix<std::size_t, dim, 1> counts;
  for (int axis = 0; axis < dim; ++axis) {
    counts[axis] = static_cast<std::size_t>(std::lround(box.extent()[axis] / spacing));
    total *= counts[axis];
  }
  for (std::size_t n = 0; n < total; ++n) {
    std::size_t rest = n;
    Vector<dim> x;
    for (int axis = 0; axis < dim; ++axis) {
      const auto place = static_cast<double>(rest % counts[axis]);
      rest /= counts[axis];
      const double step = 2 * uniform({seed, static_cast<std::uint64_t>(axis), n}) - 1;
      x[axis] = box.lower[axis] + spacing * (place + 0.5 + jitter * step);
    }
    cloud.positions.push_back(x);
  }
  return cloud;
}

}  // namespace hemoscale::micro::test
