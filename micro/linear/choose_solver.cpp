#include "micro/linear/choose_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "micro/error.hpp"
#include "micro/linear/aggregate_solver.hpp"
#include "micro/linear/banded_solver.hpp"
#include "micro/linear/hypre_solver.hpp"
#include "micro/linear/ordering.hpp"
#include "micro/linear/sparse_direct_solver.hpp"

namespace hemoscale::micro {
namespace {

// Measured (README of this folder) with 29 entries a row. The work of a band is as its half-width
// squared, that of iterations as the entries of a row: these are the ratios where they are equal.
constexpr double cholesky_pays = 680;  // [-] half-width 140 at 29 entries a row
constexpr double lu_pays = 195;        // [-] half-width 75

// The band of a coupled system was faster than the general LU wherever both were measured, by a
// factor of four at half-widths up to 905; beyond this one its memory is too large.
constexpr std::size_t widest_coupled = 1500;  // [-]

constexpr std::size_t small = 400;    // [-] rows: nothing else is worth while
constexpr double clearly_wide = 300;  // [-] expected half-width for which no order need be found

// Half the band that an order by columns will have, without ordering: nodes across the longest axis
// times the reach of the operator in spacings.
template <int dim>
double expected_half_width(const SparsePattern& pattern, const NodeLayout<dim>& layout) {
  Vector<dim> lower = layout.positions.front();
  Vector<dim> upper = lower;
  for (const Vector<dim>& x : layout.positions) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  const double columns = std::max(1.0, (upper - lower).maxCoeff() / layout.spacing);
  const double across = static_cast<double>(layout.positions.size()) / columns;
  const auto entries =
      static_cast<double>(pattern.columns.size()) / static_cast<double>(pattern.rows());
  return across * std::pow(entries, 1.0 / dim) / 2;
}

[[noreturn]] void refuse(LinearSolverKind kind, const std::string& reason) {
  throw ParameterError(fmt::format("linear solver {} does not fit: {}", name_of(kind), reason));
}

}  // namespace

std::string name_of(LinearSolverKind kind) {
  switch (kind) {
    case LinearSolverKind::automatic:
      return "automatic";
    case LinearSolverKind::banded:
      return "banded";
    case LinearSolverKind::sparse_direct:
      return "sparse_direct";
    case LinearSolverKind::aggregate:
      return "aggregate";
    case LinearSolverKind::hypre:
      return "hypre";
  }
  return "unknown";
}

LinearSolverKind choose_kind(const SparsePattern& pattern, const SystemTraits& traits,
                             std::size_t half_width) {
  if (!pattern.is_whole()) {
    return LinearSolverKind::hypre;
  }
  if (traits.unknowns_per_node > 1) {
    return half_width <= widest_coupled ? LinearSolverKind::banded
                                        : LinearSolverKind::sparse_direct;
  }
  const double entries =
      static_cast<double>(pattern.columns.size()) / static_cast<double>(pattern.rows());
  const auto width = static_cast<double>(half_width);
  const double ratio = traits.symmetric ? cholesky_pays : lu_pays;
  return pattern.rows() <= small || width * width <= ratio * entries ? LinearSolverKind::banded
                                                                     : LinearSolverKind::aggregate;
}

template <int dim>
std::unique_ptr<LinearSolver> make_solver(LinearSolverKind kind, const SparsePattern& pattern,
                                          const NodeLayout<dim>& layout, const SystemTraits& traits,
                                          const SolveTolerance& tolerance,
                                          const Communicator& ranks) {
  if (layout.positions.empty() || !(layout.spacing > 0)) {
    throw ParameterError(fmt::format(
        "a linear solver is chosen for one or more nodes of positive spacing; got {} nodes, "
        "spacing {:.4g} m",
        layout.positions.size(), layout.spacing));
  }
  // Ordering a large system takes a good part of the time that it takes to solve it.
  if (kind == LinearSolverKind::automatic && pattern.is_whole() && traits.unknowns_per_node == 1 &&
      pattern.rows() > small && expected_half_width(pattern, layout) > clearly_wide) {
    kind = LinearSolverKind::aggregate;
  }
  Ordering order;
  if (pattern.is_whole() &&
      (kind == LinearSolverKind::automatic || kind == LinearSolverKind::banded)) {
    order = column_order(pattern, layout, traits.unknowns_per_node);
  }
  if (kind == LinearSolverKind::automatic) {
    kind = choose_kind(pattern, traits, order.bandwidth.lower);
  }
  if (!pattern.is_whole() && kind != LinearSolverKind::hypre) {
    refuse(kind, "rows are spread over ranks, which hypre alone can solve");
  }
  const bool scalar = traits.unknowns_per_node == 1;
  switch (kind) {
    case LinearSolverKind::banded:
      return std::make_unique<BandedSolver>(std::move(order), tolerance, traits.null_space,
                                            traits.symmetric);
    case LinearSolverKind::aggregate:
      if (!scalar) {
        refuse(kind, "it solves systems of one unknown a node; use banded or sparse_direct");
      }
      return std::make_unique<AggregateSolver<dim>>(layout, traits.symmetric, tolerance,
                                                    traits.null_space);
    case LinearSolverKind::hypre:
      if (!scalar) {
        refuse(kind,
               "it solves systems of one unknown a node; use banded or sparse_direct on one "
               "rank");
      }
      return std::make_unique<HypreSolver>(ranks, traits.symmetric, tolerance, traits.null_space);
    case LinearSolverKind::sparse_direct:
    case LinearSolverKind::automatic:
      break;
  }
  return std::make_unique<SparseDirectSolver>(traits.symmetric, tolerance, traits.null_space);
}

template std::unique_ptr<LinearSolver> make_solver(LinearSolverKind, const SparsePattern&,
                                                   const NodeLayout<2>&, const SystemTraits&,
                                                   const SolveTolerance&, const Communicator&);
template std::unique_ptr<LinearSolver> make_solver(LinearSolverKind, const SparsePattern&,
                                                   const NodeLayout<3>&, const SystemTraits&,
                                                   const SolveTolerance&, const Communicator&);

}  // namespace hemoscale::micro
