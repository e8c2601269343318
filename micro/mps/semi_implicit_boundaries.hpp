#pragma once

#include "micro/mps/semi_implicit_parts.hpp"

namespace hemoscale::micro {

/// Whether momentum is solved for such a particle.
inline bool is_free(ParticleKind kind) {
  return kind == ParticleKind::fluid || kind == ParticleKind::surface;
}

/// Whether a particle of the fluid belongs to a membrane: a patch of the kind `fluid`.
template <int dim>
bool is_tied(const ParticleSet<dim>& particles, std::size_t i) {
  return is_free(particles.kinds[i]) && particles.patches[i] >= 0;
}

/// Depth of every wall and dummy particle behind the wall plane, which lies half a spacing before
/// the wall particles: half a spacing more than the distance from the nearest of them; zero for
/// other particles.
template <int dim>
std::vector<double> wall_depths(const FlowDomain<dim>& domain);

/// Sets up the search for the fluid at the places from which the boundaries take their velocities:
/// the mirror image of a wall or dummy particle in the wall plane, and the fluid before an outlet.
/// Called after each neighbour search.
template <int dim>
void find_probes(const SemiImplicitSetting<dim>& setting, const SemiImplicitState<dim>& state,
                 SemiImplicitWork<dim>& work);

/// Prescribed velocities at time t: walls, dummies and inlets from their patches.
template <int dim>
void impose_velocities(const SemiImplicitSetting<dim>& setting, double t,
                       ParticleSet<dim>& particles);

/// Velocities of outlet particles: along the normal that of the fluid one spacing before the zone,
/// at the same place across (a linear fit), across it none.
/// @throws NumericalError naming the particle if there is no fluid to take it from
template <int dim>
void extrapolate_to_outlets(const SemiImplicitSetting<dim>& setting, SemiImplicitState<dim>& state,
                            const SemiImplicitWork<dim>& work);

/// Velocities as the viscous term sees them. With mirrored walls, a particle at the depth d behind
/// a wall of velocity u_w has
///
///   u = u_w - d sum_k w_k (u_k - u_w) / sum_k w_k d_k
///
/// over the fluid particles k around its mirror image, d_k their distances from the wall plane: a
/// linear profile has the velocity of the wall at the plane. Where there is no fluid, u = u_w.
template <int dim>
void see_velocities(const SemiImplicitSetting<dim>& setting, const SemiImplicitState<dim>& state,
                    SemiImplicitWork<dim>& work);

}  // namespace hemoscale::micro
