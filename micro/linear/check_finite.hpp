#pragma once

#include <span>

#include "micro/linear/sparse_matrix.hpp"

namespace hemoscale::micro {

/// @throws NumericalError naming the first entry that is not finite
void check_finite(const SparseMatrix& matrix);

/// @param name  of the vector, for the message
/// @throws NumericalError naming the first value that is not finite
void check_finite(std::span<const double> values, const char* name);

}  // namespace hemoscale::micro
