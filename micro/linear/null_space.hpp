#pragma once

#include <cstddef>
#include <span>

#include "micro/linear/sparse_matrix.hpp"

namespace hemoscale::micro {

/// Unknowns to which a constant can be added without changing A x: the pressure where no boundary
/// gives its value. Unknown `first`, `first + stride`, ... to the end of the system.
///
/// Of such a system every solver solves
///
///     A x + lambda e = b,   e.x = 0,   e = 1 on those unknowns, else 0,
///
/// that is, P A x = P b with P = 1 - e e^T / e.e. A right-hand side that the matrix cannot reach is
/// missed by the same lambda in all of these rows, and the solution has no mean. The matrix need
/// not be symmetric: only A e = 0 is used.
struct ConstantNullSpace {
  std::size_t first = 0;  // [-]
  std::size_t stride =
      1;  // [-] 1 for scalar systems, dim + 1 for interleaved velocity and pressure

  std::size_t size(std::size_t unknowns) const {
    return first < unknowns ? (unknowns - first + stride - 1) / stride : 0;
  }
};

/// Checks that A e = 0.
/// @throws ParameterError if the description holds no unknown of the system
/// @throws NumericalError naming the row that misses most, if it misses by more than 1e-8 of the
///         sum of its absolute values
void check_null_space(const SparseMatrix& matrix, const ConstantNullSpace& null_space);

/// Takes the mean over the described unknowns off them: v <- P v.
void remove_mean(const ConstantNullSpace& null_space, std::span<double> v);

}  // namespace hemoscale::micro
