#pragma once

#include <cstddef>
#include <vector>

#include "micro/mps/pair_geometry.hpp"

namespace hemoscale::micro {

/// Multiplies the weights of the gradient of each particle by the matrix that makes them exact for
/// linear fields on any particles,
///
///   g_ij <- [sum_j g_ij (r_j - r_i)^T]^-1 g_ij
///
/// (Randles and Libersky 1996; for the moving-particle method Khayyer and Gotoh 2011). It costs the
/// exact conservation of momentum. Neighbours of weight zero are left out of the matrix.
///
/// @param wanted  of each particle, whether its gradient is used: others keep the plain weights and
///        do not count; empty for all
/// @param gradient  plain weights in, corrected ones out
/// @param condition_bound  particles whose matrix has a larger condition number, such as stray ones
///        with all neighbours in a line, keep the plain weights; above 1
/// @returns the number of those
template <int dim>
std::size_t correct_gradient(const PairGeometry<dim>& pairs, const NeighbourTable& table,
                             double condition_bound, const std::vector<char>& wanted,
                             std::vector<Vector<dim>>& gradient);

}  // namespace hemoscale::micro
