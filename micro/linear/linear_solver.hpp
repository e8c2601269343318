#pragma once

#include <span>
#include <string>

#include "micro/linear/sparse_matrix.hpp"

namespace hemoscale::micro {

/// When an iteration has converged; direct solvers only check it.
struct SolveTolerance {
  double relative_residual = 1e-10;  // [-] |b - A x| / |b|
  int maximum_iterations = 2000;     // [-]
};

struct SolveReport {
  int iterations = 0;            // [-] 0 of a direct solver
  double relative_residual = 0;  // [-] as the solver knows it; direct solvers compute it
};

/// Solves A x = b again and again for matrices of one pattern.
///
/// Vectors are whole on every rank; a distributed solver is collective and leaves the same solution
/// on all ranks.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// Takes the values: factors, or sets up the preconditioner. The matrix may change or vanish
  /// afterwards.
  /// @throws NumericalError if the matrix is singular or holds values that are not finite
  virtual void prepare(const SparseMatrix& matrix) = 0;

  /// @param b  right-hand side, global_rows() values
  /// @param x  first guess in, solution out (direct solvers ignore the guess)
  /// @throws NumericalError with iterations and residual if it does not converge
  virtual SolveReport solve(std::span<const double> b, std::span<double> x) = 0;

  /// For reports, e.g. "banded LU, bandwidth 135".
  virtual std::string describe() const = 0;
};

}  // namespace hemoscale::micro
