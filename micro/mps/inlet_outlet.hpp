#pragma once

#include <cstdint>
#include <vector>

#include "micro/mps/flow_domain.hpp"

namespace hemoscale::micro {

/// A plane through which the fluid enters; inlet particles wait behind it in layers.
template <int dim>
struct Inlet {
  std::int32_t patch = -1;
  Vector<dim> normal = Vector<dim>::Zero();  // out of the fluid
  double plane = 0;                          // [m] normal . x of the plane
  double depth = 0;                          // [m] of all layers
};

/// A zone in which the pressure is given; particles leave at its far plane.
template <int dim>
struct Outlet {
  std::int32_t patch = -1;
  Vector<dim> normal = Vector<dim>::Zero();  // out of the fluid
  double edge = 0;                           // [m] normal . x where the zone begins
  double plane = 0;                          // [m] and where it ends
};

template <int dim>
struct Openings {
  std::vector<Inlet<dim>> inlets;
  std::vector<Outlet<dim>> outlets;
};

/// Balance of particles: moving ones now = initial + entered - left.
struct ParticleLedger {
  std::int64_t next_identity = 0;
  std::int64_t initial = 0;  // fluid, surface and outlet particles at the beginning
  std::int64_t entered = 0;
  std::int64_t left = 0;
};

/// Fluid, surface and outlet particles of a set.
template <int dim>
std::int64_t count_moving(const ParticleSet<dim>& particles);

/// Reads the planes off the inlet and outlet particles of a domain: each lies half a spacing beyond
/// the outermost of them.
/// @throws ParameterError if the particles of one patch have different normals
template <int dim>
Openings<dim> find_openings(const FlowDomain<dim>& domain);

/// Lets inlet particles that have passed their plane become fluid, each leaving a new one behind at
/// the tail of its row; fluid particles in an outlet zone become outlet particles and the reverse;
/// those beyond the plane are removed.
/// @param depths  further value of each particle, kept in step with the set (zero for new ones)
/// @returns whether particles were added, removed or changed sides
template <int dim>
bool pass_openings(const Openings<dim>& openings, ParticleSet<dim>& particles,
                   std::vector<double>& depths, ParticleLedger& ledger);

}  // namespace hemoscale::micro
