#pragma once

#include <vector>

#include "micro/mps/mps_kernel.hpp"
#include "micro/mps/pair_geometry.hpp"

namespace hemoscale::micro {

/// Particle number density n_i = sum_j w_ij over the gradient radius [-], w = radius / r - 1.
template <int dim>
void number_density(const MpsKernel& kernel, const PairGeometry<dim>& pairs,
                    const NeighbourTable& table, std::vector<double>& density);

/// Its rate of change as the particles move [1/s],
///
///   (dn/dt)_i = -radius sum_j (r_j - r_i).(u_j - u_i) / |r_j - r_i|^3
///
/// (Khayyer and Gotoh 2009), which is -n0 times the divergence.
template <int dim>
void density_rate(const MpsKernel& kernel, const PairGeometry<dim>& pairs,
                  const NeighbourTable& table, const std::vector<Vector<dim>>& velocities,
                  std::vector<double>& rate);

}  // namespace hemoscale::micro
