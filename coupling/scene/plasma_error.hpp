#pragma once

#include "coupling/scene/plasma_scene.hpp"

namespace hemoscale::coupling {

/// Distance of the particles from the exact flow of a scene, over the particles between its
/// abscissae: velocities over the largest exact speed, pressures (less their means) over the
/// largest exact pressure; root mean square and largest.
struct PlasmaError {
  double velocity = 0;          // [-] root mean square
  double largest_velocity = 0;  // [-]
  double pressure = 0;          // [-] root mean square; 0 where the exact pressure is constant
  std::size_t particles = 0;    // [-] that were compared
};

/// @param with_boundaries  whether nodes on the boundaries count
/// @pre the scene has an exact flow
template <int dim>
PlasmaError plasma_error(const PlasmaScene<dim>& scene, const micro::ParticleSet<dim>& particles,
                         double time, bool with_boundaries);

}  // namespace hemoscale::coupling
