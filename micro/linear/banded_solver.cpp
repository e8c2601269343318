#include "micro/linear/banded_solver.hpp"

#include <cblas.h>
#include <fmt/format.h>
#include <lapacke.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "micro/error.hpp"
#include "micro/linear/one_blas_thread.hpp"

namespace hemoscale::micro {

namespace {

static_assert(sizeof(lapack_int) == sizeof(std::int32_t), "LAPACK with 32-bit indices");

// LAPACK says by a negative code which argument it refuses: one that is not finite, or too large.
void require_accepted(lapack_int code, const char* call) {
  if (code < 0) {
    throw NumericalError(fmt::format(
        "LAPACK refuses argument {} of {}; look for values that are not finite", -code, call));
  }
}

}  // namespace

BandedSolver::BandedSolver(Ordering ordering, const SolveTolerance& tolerance,
                           std::optional<ConstantNullSpace> null_space, bool symmetric)
    : DirectSolver(tolerance, null_space), ordering_(std::move(ordering)), symmetric_(symmetric) {
  use_one_blas_thread();
}

// Storage of the band: a column after the other, each with its diagonal entry in the same place.
double& BandedSolver::band_entry(std::size_t row, std::size_t column) {
  const auto [lower, upper] = ordering_.bandwidth;
  return band_[(symmetric_ ? 0 : lower + upper) + row - column + column * leading_];
}

void BandedSolver::fill(const SparseMatrix& scaled) {
  const SparsePattern& pattern = *scaled.pattern;
  const std::size_t n = pattern.rows();
  const auto [lower, upper] = ordering_.bandwidth;
  leading_ = symmetric_ ? lower + 1 : 2 * lower + upper + 1;
  band_.assign(leading_ * n, 0.0);
  sign_ = symmetric_ && scaled.values[pattern.entry(0, 0)] < 0 ? -1 : 1;
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<std::size_t>(ordering_.place[i]);
    for (auto k = static_cast<std::size_t>(pattern.first[i]);
         k < static_cast<std::size_t>(pattern.first[i + 1]); ++k) {
      const auto column =
          static_cast<std::size_t>(ordering_.place[static_cast<std::size_t>(pattern.columns[k])]);
      if (row > column + lower || column > row + upper) {
        throw ParameterError(fmt::format(
            "matrix entry ({}, {}) lies outside the band of {} below and {} above the diagonal; "
            "order the unknowns again after a change of the pattern",
            i, pattern.columns[k], lower, upper));
      }
      if (!symmetric_ || row >= column) {
        band_entry(row, column) = sign_ * scaled.values[k];
      }
    }
  }
}

void BandedSolver::factor(const SparseMatrix& scaled, bool) {
  const std::size_t n = scaled.pattern->rows();
  if (ordering_.place.size() != n) {
    throw ParameterError(fmt::format("an order of {} unknowns does not fit a matrix of {} rows",
                                     ordering_.place.size(), n));
  }
  fill(scaled);
  const auto rows = static_cast<lapack_int>(n);
  const auto lower = static_cast<lapack_int>(ordering_.bandwidth.lower);
  const auto upper = static_cast<lapack_int>(ordering_.bandwidth.upper);
  const auto leading = static_cast<lapack_int>(leading_);
  lapack_int fault = 0;
  if (symmetric_) {
    fault = LAPACKE_dpbtrf_work(LAPACK_COL_MAJOR, 'L', rows, lower, band_.data(), leading);
  } else {
    pivots_.resize(n);
    fault = LAPACKE_dgbtrf_work(LAPACK_COL_MAJOR, rows, rows, lower, upper, band_.data(), leading,
                                pivots_.data());
  }
  if (fault > 0) {
    const auto found = std::find(ordering_.place.begin(), ordering_.place.end(), fault - 1);
    throw NumericalError(fmt::format(
        "{}: the matrix is {}: no pivot for unknown {}; check that boundary conditions fix every "
        "unknown, or describe the null space",
        describe(), symmetric_ ? "singular or not definite" : "singular",
        found - ordering_.place.begin()));
  }
  require_accepted(fault, symmetric_ ? "dpbtrf" : "dgbtrf");
  if (!symmetric_) measure_fill();
}

/// The band has room for any pivots; most of it stays empty where few rows are exchanged, and back
/// substitution is as fast as its columns are read from memory.
void BandedSolver::measure_fill() {
  const std::size_t n = pivots_.size();
  const auto [lower, upper] = ordering_.bandwidth;
  const std::size_t most = lower + upper;
  heights_.resize(n);
  depths_.resize(n);
  for (std::size_t j = 0; j < n; ++j) {
    const double* const column = band_.data() + j * leading_;
    std::size_t height = std::min(most, j);
    while (height > 0 && column[most - height] == 0) --height;
    std::size_t depth = std::min(lower, n - 1 - j);
    while (depth > 0 && column[most + depth] == 0) --depth;
    heights_[j] = static_cast<std::int32_t>(height);
    depths_[j] = static_cast<std::int32_t>(depth);
  }
}

void BandedSolver::back_substitute(std::span<double> v) const {
  ordered_.resize(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) {
    ordered_[static_cast<std::size_t>(ordering_.place[i])] = v[i];
  }
  if (symmetric_) {
    const auto n = static_cast<lapack_int>(v.size());
    const auto lower = static_cast<lapack_int>(ordering_.bandwidth.lower);
    const auto leading = static_cast<lapack_int>(leading_);
    require_accepted(LAPACKE_dpbtrs_work(LAPACK_COL_MAJOR, 'L', n, lower, 1, band_.data(), leading,
                                         ordered_.data(), n),
                     "dpbtrs");
  } else {
    // As dgbtrs does, but over the filled part of each column alone.
    const std::size_t diagonal = ordering_.bandwidth.lower + ordering_.bandwidth.upper;
    double* const x = ordered_.data();
    for (std::size_t j = 0; j < v.size(); ++j) {
      std::swap(x[j], x[static_cast<std::size_t>(pivots_[j]) - 1]);
      cblas_daxpy(depths_[j], -x[j], band_.data() + j * leading_ + diagonal + 1, 1, x + j + 1, 1);
    }
    for (std::size_t j = v.size(); j-- > 0;) {
      const auto height = static_cast<std::size_t>(heights_[j]);
      const double* const pivot = band_.data() + j * leading_ + diagonal;
      x[j] /= *pivot;
      cblas_daxpy(heights_[j], -x[j], pivot - height, 1, x + j - height, 1);
    }
  }
  for (std::size_t i = 0; i < v.size(); ++i) {
    v[i] = sign_ * ordered_[static_cast<std::size_t>(ordering_.place[i])];
  }
}

std::string BandedSolver::describe() const {
  return fmt::format("banded {}, {} unknowns, bandwidth {} below and {} above",
                     symmetric_ ? "Cholesky" : "LU", ordering_.place.size(),
                     ordering_.bandwidth.lower, ordering_.bandwidth.upper);
}

}  // namespace hemoscale::micro
