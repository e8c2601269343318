#pragma once

#include <vector>

#include "micro/mps/operator_kind.hpp"
#include "micro/particles/neighbour_table.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Pressure gradient of the moving-particle method in the form of `form`:
///
///   difference:     sum_j g_ij (p_j - p_i)
///   minimum:        sum_j g_ij (p_j - m_i),               m_i = least p of i and its neighbours
///   antisymmetric:  sum_j g_ij (p_i + p_j - m_i - m_j)
///
/// The last two are positive in every pair: particles repel. On a full lattice, where the weights g
/// of a particle sum to zero, `minimum` agrees with `difference`. `antisymmetric` does not: for a
/// linear field p_j - m_j is the same everywhere, and the sum vanishes. It is kept as published.
///
/// @param gradient  weights g_ij [1/m], zero for neighbours without pressure (and beyond the
/// radius)
/// @param lowest  scratch: m_i [Pa]; not touched by `difference`
template <int dim>
void apply_pressure_gradient(GradientForm form, const std::vector<Vector<dim>>& gradient,
                             const NeighbourTable& table, const std::vector<double>& pressures,
                             std::vector<double>& lowest, std::vector<Vector<dim>>& result);

}  // namespace hemoscale::micro
