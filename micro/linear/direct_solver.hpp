#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "micro/linear/linear_solver.hpp"
#include "micro/linear/null_space.hpp"
#include "micro/linear/sparse_matrix.hpp"

namespace hemoscale::micro {

/// What direct solvers share: scaling, iterative refinement, the check of the residual, and systems
/// with a constant null space.
///
/// Rows and then columns are scaled by powers of two such that their largest values lie in [1/2,
/// 1]: equations and unknowns of different units meet in coupled systems, and pivots are chosen by
/// size.
///
/// Null space: one unknown p is held at zero, its equation left out. With y = A_p^-1 b and
/// w = A_p^-1 e the solution is x = y - lambda w minus its mean, and the equation left out gives
/// lambda = (b_p - a_p.y) / (e_p - a_p.w). w is computed once per matrix.
class DirectSolver : public LinearSolver {
 public:
  void prepare(const SparseMatrix& matrix) final;
  SolveReport solve(std::span<const double> b, std::span<double> x) final;

 protected:
  DirectSolver(const SolveTolerance& tolerance, std::optional<ConstantNullSpace> null_space);

  /// Factors the scaled matrix, whose pattern is that of the one before if `same_pattern`.
  /// @throws NumericalError if it is singular
  virtual void factor(const SparseMatrix& scaled, bool same_pattern) = 0;

  /// v <- A^-1 v with the factors.
  virtual void back_substitute(std::span<double> v) const = 0;

  /// Symmetric scaling, by the diagonal, for factorisations that need it.
  virtual bool is_symmetric() const { return false; }

  std::size_t unknowns() const { return rows_.size(); }

 private:
  void scale(SparseMatrix& matrix);
  void pin(SparseMatrix& scaled) const;
  void apply_inverse(std::span<double> v) const;  // of the unscaled, pinned matrix
  void correct(std::span<double> residual, std::span<double> x, double& lambda) const;

  SolveTolerance tolerance_;
  std::optional<ConstantNullSpace> null_space_;
  SparseMatrix matrix_;                 // own copy: residuals need it
  std::vector<double> rows_, columns_;  // [-] scaling
  std::vector<double> border_;          // w
  double border_pivot_ = 0;             // e_p - a_p.w
};

}  // namespace hemoscale::micro
