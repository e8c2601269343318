#pragma once

#include <vector>

#include "micro/mps/node_range.hpp"
#include "micro/particles/neighbour_table.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Discrete gradient and Laplacian as weights of differences, entry by entry of a neighbour table:
///
///   (grad phi)_i = sum_j gradient_ij (phi_j - phi_i),   (lap phi)_i = sum_j laplacian_ij (phi_j -
///   phi_i)
///
/// The divergence of a vector field takes the gradient weights.
template <int dim>
struct Stencils {
  std::vector<Vector<dim>> gradient;  // [1/m]
  std::vector<double> laplacian;      // [1/m^2]

  /// With several ranks: the rows that this one holds. The operators then gather their results, so
  /// that all ranks get all values.
  const Communicator* ranks = nullptr;
  NodeRange own;

  NodeRange rows(std::size_t count) const { return ranks != nullptr ? own : NodeRange{0, count}; }
};

/// Joins the rows of all ranks of a result; nothing to do for one rank.
template <int dim>
void gather_rows(const Stencils<dim>& stencils, std::vector<double>& values);
template <int dim>
void gather_rows(const Stencils<dim>& stencils, std::vector<Vector<dim>>& values);

/// Rows are independent and each is summed in the order of its neighbours: same bits for any number
/// of threads. All arrays have one value for each particle.
template <int dim>
void apply_gradient(const Stencils<dim>& stencils, const NeighbourTable& table,
                    const std::vector<double>& field, std::vector<Vector<dim>>& result);
template <int dim>
void apply_laplacian(const Stencils<dim>& stencils, const NeighbourTable& table,
                     const std::vector<double>& field, std::vector<double>& result);
template <int dim>
void apply_laplacian(const Stencils<dim>& stencils, const NeighbourTable& table,
                     const std::vector<Vector<dim>>& field, std::vector<Vector<dim>>& result);
template <int dim>
void apply_divergence(const Stencils<dim>& stencils, const NeighbourTable& table,
                      const std::vector<Vector<dim>>& field, std::vector<double>& result);

/// L(i,j) = d u_i / d x_j at one particle.
template <int dim>
Tensor<dim> velocity_gradient(const Stencils<dim>& stencils, const NeighbourTable& table,
                              const std::vector<Vector<dim>>& velocities, std::size_t particle);

}  // namespace hemoscale::micro
