#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "micro/linear/linear_solver.hpp"
#include "micro/linear/null_space.hpp"
#include "micro/parallel/communicator.hpp"

namespace hemoscale::micro {

class BoomerAmg;  // hides hypre

/// Algebraic multigrid of hypre [HensonYang2002] as preconditioner of conjugate gradients
/// (symmetric matrices) or flexible GMRES (others), for scalar systems whose rows are spread over
/// ranks; needs no positions.
///
/// The ranks hold consecutive ranges of rows, in their order. Vectors are whole on every rank:
/// products and corrections are gathered, so that all ranks compute, decide and fail alike. Results
/// depend on the number of ranks, within the tolerance.
///
/// MPI must be initialised, also for one process.
class HypreSolver final : public LinearSolver {
 public:
  /// @param ranks      outlives the solver
  /// @param symmetric  promises symmetric, definite matrices of either sign
  /// @throws EnvironmentError if MPI is not initialised
  HypreSolver(const Communicator& ranks, bool symmetric, const SolveTolerance& tolerance = {},
              std::optional<ConstantNullSpace> null_space = {});
  ~HypreSolver() override;

  /// Collective.
  /// @throws NumericalError on all ranks if a diagonal entry of one is zero, of the wrong sign or
  ///         not finite
  void prepare(const SparseMatrix& matrix) override;

  /// Collective; b and x are the same on all ranks.
  SolveReport solve(std::span<const double> b, std::span<double> x) override;
  std::string describe() const override;

  /// Can hypre be used in this process?
  static bool is_usable();

 private:
  /// Fills `rows_` and checks what the own rows can tell; returns the fault, or nothing.
  std::string take_rows();

  const Communicator& ranks_;
  bool symmetric_;
  SolveTolerance tolerance_;
  std::optional<ConstantNullSpace> null_space_;
  bool negative_ = false;     // definite
  SparseMatrix matrix_;       // own copy
  std::vector<double> rows_;  // factor of every local row: the sign, or one over the diagonal
  std::unique_ptr<BoomerAmg> multigrid_;
};

}  // namespace hemoscale::micro
