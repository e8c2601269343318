#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "micro/cells/ring_geometry.hpp"
#include "micro/cells/ring_mesh.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::test {

using Polygon = std::vector<micro::Vector<2>>;

/// Counter-clockwise, not convex, of the size of a red cell; the same for the same seed.
inline Polygon random_polygon(int nodes, std::uint64_t seed) {
  Polygon polygon;
  for (int i = 0; i < nodes; ++i) {
    const auto counter = static_cast<std::uint64_t>(i);
    const double radius = 3e-6 * (1 + 0.25 * (micro::uniform({seed, 0, counter}) - 0.5));
    const double jitter = 0.3 * (micro::uniform({seed, 1, counter}) - 0.5);
    const double angle = 2 * std::numbers::pi * (i + jitter) / nodes;
    polygon.emplace_back(radius * std::cos(angle), 0.7 * radius * std::sin(angle));
  }
  return polygon;
}

inline Polygon regular_polygon(int nodes, double radius) {
  Polygon polygon;
  for (int i = 0; i < nodes; ++i) {
    const double angle = 2 * std::numbers::pi * i / nodes;
    polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return polygon;
}

struct Coordinates {
  explicit Coordinates(const Polygon& polygon) {
    for (const auto& node : polygon) {
      x.push_back(node.x());
      y.push_back(node.y());
    }
  }
  std::vector<double> x, y;
};

template <class Law>
double ring_energy_of(const Law& law, const micro::RingMesh& mesh, const Polygon& polygon) {
  const Coordinates c(polygon);
  micro::RingGeometry ring(mesh.nodes);
  measure(c.x.data(), c.y.data(), ring);
  return energy(law, mesh, ring);
}

template <class Law>
Polygon ring_forces_of(const Law& law, const micro::RingMesh& mesh, const Polygon& polygon) {
  const Coordinates c(polygon);
  micro::RingGeometry ring(mesh.nodes);
  measure(c.x.data(), c.y.data(), ring);
  add_loads(law, mesh, ring);
  std::vector<double> fx(polygon.size());
  std::vector<double> fy(polygon.size());
  assemble(ring, fx.data(), fy.data());
  Polygon forces;
  for (std::size_t i = 0; i < fx.size(); ++i) {
    forces.emplace_back(fx[i], fy[i]);
  }
  return forces;
}

inline double largest_norm(const Polygon& vectors) {
  double largest = 0;
  for (const auto& v : vectors) {
    largest = std::max(largest, v.norm());
  }
  return largest;
}

}  // namespace hemoscale::test
