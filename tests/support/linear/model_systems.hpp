#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "micro/linear/node_layout.hpp"
#include "micro/linear/sparse_matrix.hpp"

namespace hemoscale::micro {

/// Which boundaries a model channel has.
enum class ChannelEnds {
  outlet,    // the last column of nodes has the value zero and is eliminated
  closed,    // nowhere a value is given: constants are a null space
  periodic,  // ends joined: constants are a null space
};

/// A model of the pressure systems of a particle method.
template <int dim>
struct ModelSystem {
  std::vector<Vector<dim>> positions;  // [m]
  SparseMatrix matrix;
  double spacing = 1;                        // [m]
  Vector<dim> period = Vector<dim>::Zero();  // [m]

  NodeLayout<dim> layout() const { return {positions, spacing, period, 0}; }
};

/// Minus the Laplacian of Koshizuka and Oka (1996), sum_j (phi_i - phi_j) w(r_ij), of range 3.1
/// spacings on a lattice shaken by `jitter` spacings; walls by natural boundary conditions.
/// @param nodes   along every axis; the last column of an `outlet` is taken off
/// @param uneven  rows are scaled by random factors in [1, 1 + uneven]: not symmetric if positive
template <int dim>
ModelSystem<dim> particle_laplacian(const std::vector<int>& nodes, ChannelEnds ends, double jitter,
                                    std::uint64_t seed, double uneven = 0);

/// Minus the Laplacian of second-degree weighted least squares of that range [spacings] on a shaken
/// channel: not symmetric, off-diagonals of either sign. The first and last columns hold rows of
/// identity (value given); the lower and upper rows of nodes state the derivative across, divided
/// by the spacing. With `closed` the ends state the derivative along instead: constants are a null
/// space.
ModelSystem<2> least_squares_laplacian(int along, int across, double range, double jitter,
                                       std::uint64_t seed, bool closed = false);

/// A full-rank matrix with about `entries` random values a row beside a diagonal; diagonally
/// dominant by `dominance` > 1, or of no particular kind if 0.
SparseMatrix random_matrix(std::size_t rows, std::size_t entries, bool symmetric, double dominance,
                           std::uint64_t seed);

/// Values in [-1, 1].
std::vector<double> random_vector(std::size_t size, std::uint64_t seed);

/// Rows of dense values as a sparse matrix that stores the diagonal and what is not zero.
SparseMatrix sparse(const std::vector<std::vector<double>>& dense);

/// |b - A x| / |b|.
double relative_residual(const SparseMatrix& matrix, const std::vector<double>& x,
                         const std::vector<double>& b);

}  // namespace hemoscale::micro
