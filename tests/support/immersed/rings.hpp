#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "micro/immersed/cell.hpp"
#include "micro/mps/lattice_domains_flows.hpp"
#include "micro/mps/limits.hpp"
#include "micro/mps/node_domains.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::micro::test {

inline constexpr Fluid plasma{.density = 1000, .kinematic_viscosity = 1e-6};

/// A circular cell, or an ellipse of the same segments, at rest in its shape.
struct Ring {
  double node_spacing = 0;  // [m]
  double radius = 0;        // [m]
  double aspect = 1;        // [-] of the outline that is given to the circular membrane
  double noise = 0;         // [m] by which nodes are displaced at most
  Vector<2> centre = Vector<2>::Zero();
};

inline Cell ring_cell(const Ring& ring, const MembraneParameters& parameters) {
  const int nodes =
      static_cast<int>(std::lround(2 * std::numbers::pi * ring.radius / ring.node_spacing));
  std::vector<Vector<2>> circle;
  Cell cell;
  for (int i = 0; i < nodes; ++i) {
    const double angle = 2 * std::numbers::pi * i / nodes;
    circle.emplace_back(ring.radius * std::cos(angle), ring.radius * std::sin(angle));
    Vector<2> x = circle.back();
    x[0] *= std::sqrt(ring.aspect);
    x[1] /= std::sqrt(ring.aspect);
    for (int axis = 0; axis < 2; ++axis) {
      const double random =
          2 * uniform({7, static_cast<std::uint64_t>(axis), static_cast<std::uint64_t>(i)}) - 1;
      x[axis] += ring.centre[axis] + ring.noise * random;
    }
    cell.positions.push_back(x);
  }
  cell.membrane =
      std::make_shared<RingMembrane>(make_ring_mesh(circle, NaturalShape::outline), parameters);
  return cell;
}

/// Square channel joined at its ends and the ring in its middle, whose nodes are slightly
/// displaced.
inline constexpr double box_rows = 14;  // [l0]
inline Cell noisy_ring(double spacing, double node_spacing, const MembraneParameters& parameters) {
  const double height = box_rows * spacing;
  return ring_cell({.node_spacing = node_spacing * spacing,
                    .radius = 0.3 * height,
                    .noise = 1e-4 * spacing,
                    .centre = {height / 2, height / 2}},
                   parameters);
}

inline double limit_of(const std::vector<Limit>& limits, const std::string& name) {
  for (const Limit& limit : limits) {
    if (limit.name == name) return limit.limit;
  }
  return 0;
}

}  // namespace hemoscale::micro::test
