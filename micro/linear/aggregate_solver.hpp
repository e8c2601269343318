#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "micro/linear/linear_solver.hpp"
#include "micro/linear/multigrid.hpp"
#include "micro/linear/node_layout.hpp"
#include "micro/linear/null_space.hpp"

namespace hemoscale::micro {

/// For large scalar systems of elliptic kind on nodes of about even spacing: multigrid on lattices
/// of overlapping aggregates of nodes, built from positions, as preconditioner of conjugate
/// gradients (symmetric matrices) or GMRES (others, whose rows are divided by their diagonal).
/// The number of iterations does not grow with the system.
///
/// The first lattice is a little wider than the operator reaches, because the operator itself damps
/// all that is shorter; every further lattice is twice as wide. A row without off-diagonal values,
/// a value given by a boundary condition, takes no part in the lattices.
///
/// Not for systems of several unknowns a node that are strongly coupled, nor for indefinite ones.
template <int dim>
class AggregateSolver final : public LinearSolver {
 public:
  /// @param symmetric  promises symmetric, definite matrices of either sign
  /// Copies the positions.
  explicit AggregateSolver(const NodeLayout<dim>& layout, bool symmetric,
                           const SolveTolerance& tolerance = {},
                           std::optional<ConstantNullSpace> null_space = {},
                           const Multigrid::Smoothing& smoothing = {});
  AggregateSolver(const AggregateSolver&) = delete;
  AggregateSolver& operator=(const AggregateSolver&) = delete;

  /// @throws NumericalError if a diagonal entry is zero, has the wrong sign or is not finite
  void prepare(const SparseMatrix& matrix) override;
  SolveReport solve(std::span<const double> b, std::span<double> x) override;
  std::string describe() const override;

 private:
  void lay_lattices(const SparsePattern& pattern, const std::vector<bool>& active);

  std::vector<Vector<dim>> positions_;  // [m]
  NodeLayout<dim> layout_;
  bool symmetric_;
  SolveTolerance tolerance_;
  std::optional<ConstantNullSpace> null_space_;
  Multigrid::Smoothing smoothing_;
  SparseMatrix matrix_;       // own copy
  std::vector<double> rows_;  // factor of every row: one over the diagonal, or one over its size
  std::vector<bool> active_;
  std::unique_ptr<Multigrid> multigrid_;
};

}  // namespace hemoscale::micro
