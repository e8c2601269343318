#pragma once

#include <vector>

#include "micro/mps/flow_domain.hpp"
#include "micro/mps/stencils.hpp"
#include "micro/particles/neighbour_table.hpp"

namespace hemoscale::micro {

/// A set of nodes at one moment with everything that depends on their places alone.
template <int dim>
struct NodeGeometry {
  double spacing = 0;  // [m] l0
  std::vector<Vector<dim>> positions;
  PeriodicBox<dim> box;
  std::vector<ParticleKind> kinds;
  std::vector<Vector<dim>> normals;  // out of the fluid; zero in it
  NeighbourTable table;
  Stencils<dim> stencils;  // of the rows of this rank

  std::size_t size() const { return positions.size(); }
};

/// One implicit stage of a time step,
///
///   rate u - nu lap u + grad p / rho = source,   div u = 0,
///
/// and its boundary values. All arrays have one value for each node.
template <int dim>
struct StageProblem {
  std::vector<Vector<dim>> source;    // [m/s^2] in the fluid; at walls and inlets: body force minus
                                      // acceleration, which fix the normal derivative of p
  std::vector<Vector<dim>> velocity;  // [m/s] imposed on walls and inlets; on outlets the part
                                      // across the normal
  std::vector<double> pressure;       // [Pa] imposed on outlets and free surfaces

  /// Normal derivative of the normal velocity on outlets [1/s]; empty: zero.
  std::vector<double> outflow_rate = {};
};

inline bool has_momentum(ParticleKind kind) {
  return kind == ParticleKind::fluid || kind == ParticleKind::surface;
}
inline bool has_given_velocity(ParticleKind kind) {
  return kind == ParticleKind::wall || kind == ParticleKind::inlet;
}
inline bool has_given_pressure(ParticleKind kind) {
  return kind == ParticleKind::outlet || kind == ParticleKind::surface;
}

/// Whether the pressure is determined up to a constant only.
inline bool has_free_pressure_level(const std::vector<ParticleKind>& kinds) {
  for (const ParticleKind kind : kinds) {
    if (has_given_pressure(kind)) return false;
  }
  return true;
}

}  // namespace hemoscale::micro
