#pragma once

#include <vector>

#include "micro/mps/mps_kernel.hpp"
#include "micro/mps/operator_kind.hpp"
#include "micro/mps/pair_geometry.hpp"
#include "micro/mps/stencils.hpp"

namespace hemoscale::micro {

/// The Laplacian of the moving-particle method (Koshizuka and Oka 1996; equation 2 of Tsubota et
/// al. 2006), w = radius / r - 1,
///
///   (lap phi)_i = factor_i sum_j w_ij (phi_j - phi_i),   factor_i = 2 d / (n0 lambda_i),
///   lambda_i = sum_j w_ij r_ij^2 / sum_j w_ij,
///
/// kept as the symmetric weights and the factors of the rows: a system divided by the factors is
/// symmetric.
struct LaplacianWeights {
  std::vector<double> weights;  // [-] w_ij, entry by entry of the neighbour table
  std::vector<double> factors;  // [1/m^2] of each particle
};

/// A particle without neighbours has the factor of the full lattice, and no Laplacian.
template <int dim>
void laplacian_weights(const MpsKernel& kernel, LaplacianScale scale,
                       const PairGeometry<dim>& pairs, const NeighbourTable& table,
                       LaplacianWeights& laplacian);

/// The gradient of the moving-particle method (equation 1 of Tsubota et al. 2006),
///
///   (grad phi)_i = (d / n0) sum_j (phi_j - phi_i) (r_j - r_i) w / |r_j - r_i|^2.
///
/// Second-order on a lattice; on disordered particles it misses even linear fields (by some 4 to
/// 17 % for displacements of 5 to 20 % of the spacing).
template <int dim>
void gradient_weights(const MpsKernel& kernel, const PairGeometry<dim>& pairs,
                      const NeighbourTable& table, std::vector<Vector<dim>>& gradient);

/// Both as stencils.
/// @param table  holds all pairs within kernel.largest_radius()
template <int dim>
Stencils<dim> mps_stencils(const MpsKernel& kernel, LaplacianScale scale,
                           const std::vector<Vector<dim>>& positions, const PeriodicBox<dim>& box,
                           const NeighbourTable& table);

}  // namespace hemoscale::micro
