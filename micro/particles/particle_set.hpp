#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "micro/vector.hpp"

namespace hemoscale::micro {

/// What a particle stands for, and with it which equations hold there.
enum class ParticleKind : std::uint8_t {
  fluid,    // momentum and continuity
  wall,     // velocity of the wall given; pressure unknown (normal momentum)
  dummy,    // behind a wall, completes the neighbourhood of the particle method; no pressure
  inlet,    // velocity given; pressure unknown (normal momentum)
  outlet,   // pressure given; velocity does not change along the normal
  surface,  // free surface: momentum holds, pressure is zero
};

/// Particles of a fluid and its boundaries: arrays of equal length, no behaviour.
template <int dim>
struct ParticleSet {
  std::vector<Vector<dim>> positions;    // [m]
  std::vector<Vector<dim>> velocities;   // [m/s]
  std::vector<double> pressures;         // [Pa]
  std::vector<ParticleKind> kinds;       // [-]
  std::vector<std::int32_t> patches;     // [-] boundary the particle belongs to; -1 in the fluid
  std::vector<Vector<dim>> normals;      // [-] of boundaries, unit, out of the fluid; else zero
  std::vector<double> measures;          // [m, 3-D: m^2] share of the boundary; else zero
  std::vector<std::int64_t> identities;  // [-] constant over the life of a particle

  std::size_t size() const { return positions.size(); }

  /// A fluid particle at rest is the default of everything but position and identity.
  void append(const Vector<dim>& position, std::int64_t identity,
              ParticleKind kind = ParticleKind::fluid, std::int32_t patch = -1,
              const Vector<dim>& normal = Vector<dim>::Zero(), double measure = 0) {
    positions.push_back(position);
    velocities.push_back(Vector<dim>::Zero());
    pressures.push_back(0);
    kinds.push_back(kind);
    patches.push_back(patch);
    normals.push_back(normal);
    measures.push_back(measure);
    identities.push_back(identity);
  }
};

}  // namespace hemoscale::micro
