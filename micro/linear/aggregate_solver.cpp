#include "micro/linear/aggregate_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "micro/error.hpp"
#include "micro/linear/check_finite.hpp"
#include "micro/linear/lattice_interpolation.hpp"
#include "micro/linear/outer_iteration.hpp"

namespace hemoscale::micro {
namespace {

// Measured (README): the widest lattice for which the iterations do not yet grow noticeably.
constexpr double lattice_per_range = 1.3;  // [-]
constexpr double least_lattice = 2;        // [-] spacings
constexpr double coarsening = 2;           // [-] from lattice to lattice

// The coarsest lattice is factored; this many unknowns cost less than another level.
constexpr std::size_t coarsest = 600;

// How far an operator of that many entries a row reaches, in spacings: the radius of the disc or
// ball with as many nodes.
template <int dim>
double range_of(double entries) {
  if constexpr (dim == 2) {
    return std::sqrt(entries / std::numbers::pi);
  } else {
    return std::cbrt(entries * 3 / (4 * std::numbers::pi));
  }
}

}  // namespace

template <int dim>
AggregateSolver<dim>::AggregateSolver(const NodeLayout<dim>& layout, bool symmetric,
                                      const SolveTolerance& tolerance,
                                      std::optional<ConstantNullSpace> null_space,
                                      const Multigrid::Smoothing& smoothing)
    : positions_(layout.positions.begin(), layout.positions.end()),
      layout_{positions_, layout.spacing, layout.period, layout.slide},
      symmetric_(symmetric),
      tolerance_(tolerance),
      null_space_(null_space),
      smoothing_(smoothing) {
  if (positions_.empty() || !(layout.spacing > 0)) {
    throw ParameterError(
        fmt::format("lattices need one or more nodes of positive spacing; got {} nodes, spacing "
                    "{:.4g} m",
                    positions_.size(), layout.spacing));
  }
  for (const Vector<dim>& x : positions_) {
    if (!x.allFinite()) {
      throw NumericalError("a position is not finite; look for an earlier blow-up");
    }
  }
}

template <int dim>
void AggregateSolver<dim>::lay_lattices(const SparsePattern& pattern,
                                        const std::vector<bool>& active) {
  active_ = active;
  const double entries = static_cast<double>(pattern.columns.size()) /
                         static_cast<double>(std::max<std::size_t>(1, pattern.rows()));
  double spacing =
      layout_.spacing * std::max(least_lattice, lattice_per_range * range_of<dim>(entries));
  std::vector<Interpolation> interpolations;
  CoarseLattice<dim> lattice = lay_lattice(layout_, spacing, active);
  while (true) {
    interpolations.push_back(std::move(lattice.interpolation));
    const std::size_t size = lattice.positions.size();
    if (size <= coarsest) {
      break;
    }
    spacing *= coarsening;
    CoarseLattice<dim> next = lay_lattice(lattice.layout(), spacing, std::vector<bool>(size, true));
    if (next.positions.size() >= size) {
      break;
    }
    lattice = std::move(next);
  }
  multigrid_ = std::make_unique<Multigrid>(std::move(interpolations), smoothing_);
}

template <int dim>
void AggregateSolver<dim>::prepare(const SparseMatrix& matrix) {
  const SparsePattern& pattern = *matrix.pattern;
  if (!pattern.is_whole() || pattern.rows() != positions_.size()) {
    throw ParameterError(fmt::format(
        "the aggregate solver needs all rows of a scalar system, one a node; got {} of {} rows and "
        "{} nodes; choose a direct or a distributed solver",
        pattern.rows(), pattern.global_rows, positions_.size()));
  }
  check_finite(matrix);
  if (null_space_) {
    check_null_space(matrix, *null_space_);
  }
  const bool same_pattern = matrix_.pattern == matrix.pattern;
  matrix_ = matrix;
  rows_.resize(pattern.rows());
  std::vector<bool> active(pattern.rows());
  double largest = 0;
  for (std::size_t i = 0; i < pattern.rows(); ++i) {
    double diagonal = 0;
    for (auto k = static_cast<std::size_t>(pattern.first[i]);
         k < static_cast<std::size_t>(pattern.first[i + 1]); ++k) {
      if (static_cast<std::size_t>(pattern.columns[k]) == i) {
        diagonal = matrix.values[k];
      } else if (matrix.values[k] != 0) {
        active[i] = true;
      }
    }
    if (diagonal == 0 || (symmetric_ && diagonal * largest < 0)) {
      throw NumericalError(fmt::format(
          "diagonal entry {} is {:.3g}; the aggregate solver needs {}; choose a direct solver", i,
          diagonal, symmetric_ ? "a definite matrix" : "diagonals that are not zero"));
    }
    largest = std::abs(diagonal) > std::abs(largest) ? diagonal : largest;
    rows_[i] = 1 / diagonal;
  }
  if (symmetric_) {
    std::fill(rows_.begin(), rows_.end(), 1 / largest);
  }
  if (!multigrid_ || !same_pattern || active != active_) {
    lay_lattices(pattern, active);
  }
  multigrid_->prepare(matrix_, rows_, symmetric_, null_space_.has_value());
}

template <int dim>
SolveReport AggregateSolver<dim>::solve(std::span<const double> b, std::span<double> x) {
  const std::size_t n = rows_.size();
  if (n == 0 || b.size() != n || x.size() != n) {
    throw ParameterError(
        fmt::format("vectors of {} and {} values do not fit the {} rows that were prepared",
                    b.size(), x.size(), n));
  }
  const OuterIteration iteration{symmetric_, symmetric_ && rows_.front() < 0, tolerance_,
                                 null_space_};
  return iteration.solve(
      [&](std::span<const double> v, std::span<double> y) { multiply(matrix_, v, y); },
      [&](std::span<double> r, std::span<double> z) {
        for (std::size_t i = 0; i < n; ++i) {
          r[i] *= rows_[i];
        }
        multigrid_->apply(r, z);
      },
      b, x);
}

template <int dim>
std::string AggregateSolver<dim>::describe() const {
  return fmt::format("{} with multigrid on lattices over {} nodes{}",
                     symmetric_ ? "conjugate gradients" : "GMRES", positions_.size(),
                     multigrid_ ? fmt::format(", {} levels", multigrid_->levels()) : "");
}

template class AggregateSolver<2>;
template class AggregateSolver<3>;

}  // namespace hemoscale::micro
