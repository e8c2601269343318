#pragma once

#include <vector>

#include "micro/mps/mps_kernel.hpp"
#include "micro/mps/pair_geometry.hpp"
#include "micro/mps/semi_implicit_options.hpp"
#include "micro/particles/particle_set.hpp"

namespace hemoscale::micro {

/// Displacements down the gradient of the number density,
///
///   dr_i = -C l0^2 / n0 grad n_i = -C l0^2 radius / n0 sum_j (r_j - r_i) / |r_j - r_i|^3,
///
/// of the fluid (Lind et al. 2012). Free-surface particles stay; with `ops` they, and those with a
/// neighbour on the surface, move along the surface alone (Khayyer, Gotoh and Shimizu 2017), whose
/// normal is the mean of these gradients over the neighbours.
template <int dim>
void shift_displacements(const MpsKernel& kernel, ShiftKind kind, double coefficient,
                         const PairGeometry<dim>& pairs, const NeighbourTable& table,
                         const std::vector<ParticleKind>& kinds,
                         std::vector<Vector<dim>>& displacements);

/// Value of the field of one particle at its displaced place, from a Taylor series,
///
///   phi_i + grad phi_i . dr_i + dr_i . grad grad phi_i . dr_i / 2,
///
/// with gradients of the given weights; the second derivatives are gradients of the first.
/// @param field  in: at the former places; out: at the displaced ones
template <int dim>
void follow(ShiftInterpolation interpolation, const std::vector<Vector<dim>>& gradient,
            const NeighbourTable& table, const std::vector<Vector<dim>>& displacements,
            std::vector<double>& field);

}  // namespace hemoscale::micro
