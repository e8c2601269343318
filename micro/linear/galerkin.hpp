#pragma once

#include "micro/linear/lattice_interpolation.hpp"
#include "micro/linear/sparse_matrix.hpp"

namespace hemoscale::micro {

/// The matrix that coarse nodes see: P^T A P.
/// @param rows  factor of every row of A; empty: one
SparseMatrix galerkin_product(const SparseMatrix& matrix, std::span<const double> rows,
                              const Interpolation& interpolation);

}  // namespace hemoscale::micro
