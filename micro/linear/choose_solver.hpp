#pragma once

#include <memory>
#include <optional>
#include <string>

#include "micro/linear/linear_solver.hpp"
#include "micro/linear/node_layout.hpp"
#include "micro/linear/null_space.hpp"
#include "micro/parallel/communicator.hpp"

namespace hemoscale::micro {

/// Solvers by name.
enum class LinearSolverKind {
  automatic,      // by the measured rule of choose_kind
  banded,         // LU or Cholesky in the order by columns
  sparse_direct,  // general sparse factorisation
  aggregate,      // conjugate gradients or GMRES with multigrid on lattices
  hypre,          // conjugate gradients or GMRES with hypre's algebraic multigrid; distributed
};

/// What is known of a system before its values.
struct SystemTraits {
  int unknowns_per_node = 1;  // [-] interleaved
  bool symmetric = false;     // symmetric and definite
  std::optional<ConstantNullSpace> null_space = {};
};

/// The name of a kind as the enumerator is written.
std::string name_of(LinearSolverKind kind);

/// The kind that took least time where it was measured (README of this folder), for matrices that
/// change from solve to solve:
///
///   rows spread over ranks                          hypre
///   several unknowns a node (coupled, indefinite)   banded up to a half-width of 1500, else
///                                                   sparse_direct
///   scalar, up to 400 rows, or half-width^2 up to   banded
///   680 (symmetric) or 195 times the entries a row
///   other scalar systems                            aggregate
///
/// @param half_width  of the band in the best order by columns, see column_order
LinearSolverKind choose_kind(const SparsePattern& pattern, const SystemTraits& traits,
                             std::size_t half_width);

/// Makes a solver. The layout is copied where it is needed later.
/// @param ranks  outlives the solver; the process alone unless rows are spread
/// @throws ParameterError if the kind named does not fit: the message says which would
template <int dim>
std::unique_ptr<LinearSolver> make_solver(LinearSolverKind kind, const SparsePattern& pattern,
                                          const NodeLayout<dim>& layout, const SystemTraits& traits,
                                          const SolveTolerance& tolerance,
                                          const Communicator& ranks);

}  // namespace hemoscale::micro
