#pragma once

#include <cstdint>
#include <functional>

#include "micro/mps/flow_domain.hpp"

namespace hemoscale::micro {

/// Square (cubic) lattice of particles; boundaries lie halfway between two rows.
struct Lattice {
  double spacing = 0;   // [m]
  int wall_layers = 4;  // [-] one of wall particles, the others dummies; at least the kernel radius
  double disorder = 0;  // [-] fluid particles are displaced by up to this share of the spacing
  std::uint64_t seed = 1;
};

/// Answers for a point, e.g. whether it is inside.
template <int dim>
using Region = std::function<bool(const Vector<dim>& x)>;

/// Particles at the lattice points of a box: fluid where `inside` and `filled` hold, nothing where
/// `inside` alone holds; around it, in layers, wall and dummy particles of patch 0 at rest, with
/// normals towards them from the nearest points inside. Curved walls become staircases.
/// @param box  its extents are whole numbers of spacings; along axes that are not periodic walls
/// may
///        lie in a margin of the layers around it
/// @throws ParameterError otherwise, or if there is no fluid
template <int dim>
FlowDomain<dim> lattice_around(const Lattice& lattice, const PeriodicBox<dim>& box,
                               const Region<dim>& inside, const Region<dim>& filled = nullptr);

/// Displaces fluid particles evenly in a cube of edge 2 disorder l0, by number, axis and seed.
template <int dim>
void disturb(const Lattice& lattice, ParticleSet<dim>& particles);

}  // namespace hemoscale::micro
