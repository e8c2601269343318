#include "micro/linear/direct_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "micro/error.hpp"
#include "micro/linear/check_finite.hpp"

namespace hemoscale::micro {
namespace {

// Each refinement multiplies the error by about cond(A) eps; where three do not suffice, none will.
constexpr int most_refinements = 3;

// A refinement that does not halve the residual has met round-off.
constexpr double worthwhile = 0.5;

// The equation left out contradicts the others by less than this: they do not fix the solution.
constexpr double least_border_pivot = 1e-13;  // [-] of the sum of absolute values

double power_of_two_near_inverse(double size) {
  int exponent = 0;
  std::frexp(size, &exponent);
  return std::ldexp(1.0, -exponent);
}

double row_dot(const SparseMatrix& matrix, std::size_t row, std::span<const double> x) {
  double sum = 0;
  for (auto k = static_cast<std::size_t>(matrix.pattern->first[row]);
       k < static_cast<std::size_t>(matrix.pattern->first[row + 1]); ++k) {
    sum += matrix.values[k] * x[static_cast<std::size_t>(matrix.pattern->columns[k])];
  }
  return sum;
}

}  // namespace

DirectSolver::DirectSolver(const SolveTolerance& tolerance,
                           std::optional<ConstantNullSpace> null_space)
    : tolerance_(tolerance), null_space_(null_space) {}

void DirectSolver::prepare(const SparseMatrix& matrix) {
  const SparsePattern& pattern = *matrix.pattern;
  if (!pattern.is_whole() || pattern.rows() == 0) {
    throw ParameterError(
        fmt::format("a direct solver needs all rows of a system of one row or more; it got {} of "
                    "{}; choose a distributed solver",
                    pattern.rows(), pattern.global_rows));
  }
  check_finite(matrix);
  if (null_space_) {
    check_null_space(matrix, *null_space_);
  }
  const bool same_pattern = matrix_.pattern == matrix.pattern;
  matrix_ = matrix;
  SparseMatrix scaled = matrix;
  scale(scaled);
  if (null_space_) {
    pin(scaled);
  }
  factor(scaled, same_pattern);
  if (null_space_) {
    const std::size_t p = null_space_->first;
    border_.assign(pattern.rows(), 0.0);
    for (std::size_t i = p + null_space_->stride; i < border_.size(); i += null_space_->stride) {
      border_[i] = 1;
    }
    apply_inverse(border_);
    double magnitude = 1;
    for (auto k = static_cast<std::size_t>(pattern.first[p]);
         k < static_cast<std::size_t>(pattern.first[p + 1]); ++k) {
      magnitude +=
          std::abs(matrix.values[k] * border_[static_cast<std::size_t>(pattern.columns[k])]);
    }
    border_pivot_ = 1 - row_dot(matrix_, p, border_);
    if (!(std::abs(border_pivot_) > least_border_pivot * magnitude)) {
      throw NumericalError(fmt::format(
          "the matrix is singular beyond its constant null space: with unknown {} held, the "
          "remaining pivot is {:.3g} of {:.3g}; a second unknown may be free, or a row repeat "
          "others",
          p, border_pivot_, magnitude));
    }
  }
}

void DirectSolver::scale(SparseMatrix& matrix) {
  const SparsePattern& pattern = *matrix.pattern;
  const std::size_t n = pattern.rows();
  rows_.assign(n, 0.0);
  columns_.assign(n, 0.0);
  const auto for_row = [&](std::size_t i, auto&& action) {
    for (auto k = static_cast<std::size_t>(pattern.first[i]);
         k < static_cast<std::size_t>(pattern.first[i + 1]); ++k) {
      action(matrix.values[k], static_cast<std::size_t>(pattern.columns[k]));
    }
  };
  const auto require = [](double size, const char* what, std::size_t i) {
    if (!(size > 0)) {
      throw NumericalError(fmt::format(
          "the matrix is singular: {} {} is zero; give every unknown an equation", what, i));
    }
  };
  if (is_symmetric()) {
    for (std::size_t i = 0; i < n; ++i) {
      const double diagonal =
          std::abs(matrix.values[pattern.entry(i, static_cast<std::int32_t>(i))]);
      require(diagonal, "diagonal entry", i);
      rows_[i] = columns_[i] = power_of_two_near_inverse(std::sqrt(diagonal));
    }
  } else {
    for (std::size_t i = 0; i < n; ++i) {
      for_row(i, [&](double a, std::size_t) { rows_[i] = std::max(rows_[i], std::abs(a)); });
      require(rows_[i], "row", i);
      rows_[i] = power_of_two_near_inverse(rows_[i]);
      for_row(i, [&](double a, std::size_t j) {
        columns_[j] = std::max(columns_[j], rows_[i] * std::abs(a));
      });
    }
    for (std::size_t j = 0; j < n; ++j) {
      require(columns_[j], "column", j);
      columns_[j] = power_of_two_near_inverse(columns_[j]);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for_row(i, [&](double& a, std::size_t j) { a *= rows_[i] * columns_[j]; });
  }
}

void DirectSolver::pin(SparseMatrix& scaled) const {
  const SparsePattern& pattern = *scaled.pattern;
  const auto pinned = static_cast<std::int32_t>(null_space_->first);
  for (std::size_t k = 0; k < scaled.values.size(); ++k) {
    if (pattern.columns[k] == pinned) {
      scaled.values[k] = 0;
    }
  }
  const std::size_t p = null_space_->first;
  std::fill(scaled.values.begin() + pattern.first[p], scaled.values.begin() + pattern.first[p + 1],
            0.0);
  // The sign of its diagonal keeps a definite matrix definite.
  const std::size_t diagonal = pattern.entry(p, pinned);
  scaled.values[diagonal] = std::copysign(1.0, matrix_.values[diagonal]);
}

void DirectSolver::apply_inverse(std::span<double> v) const {
  for (std::size_t i = 0; i < v.size(); ++i) {
    v[i] *= rows_[i];
  }
  back_substitute(v);
  for (std::size_t i = 0; i < v.size(); ++i) {
    v[i] *= columns_[i];
  }
}

void DirectSolver::correct(std::span<double> residual, std::span<double> x, double& lambda) const {
  double step = 0;
  if (null_space_) {
    const std::size_t p = null_space_->first;
    const double left_out = residual[p];
    residual[p] = 0;
    apply_inverse(residual);
    step = (left_out - row_dot(matrix_, p, residual)) / border_pivot_;
    lambda += step;
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] += residual[i] - step * border_[i];
    }
    remove_mean(*null_space_, x);
  } else {
    apply_inverse(residual);
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] += residual[i];
    }
  }
}

SolveReport DirectSolver::solve(std::span<const double> b, std::span<double> x) {
  const std::size_t n = rows_.size();
  if (n == 0 || b.size() != n || x.size() != n) {
    throw ParameterError(
        fmt::format("vectors of {} and {} values do not fit the {} rows that were prepared",
                    b.size(), x.size(), n));
  }
  check_finite(b, "right-hand side");
  std::fill(x.begin(), x.end(), 0.0);
  const double size = std::sqrt(dot(b, b));
  if (size == 0) {
    return {};
  }
  SolveReport report{0, 1};
  double lambda = 0;
  std::vector<double> residual(b.begin(), b.end());
  for (int refinement = 0; refinement <= most_refinements; ++refinement) {
    const double before = report.relative_residual;
    correct(residual, x, lambda);
    multiply(matrix_, x, residual);
    for (std::size_t i = 0; i < n; ++i) {
      residual[i] = b[i] - residual[i];
    }
    if (null_space_) {
      for (std::size_t i = null_space_->first; i < n; i += null_space_->stride) {
        residual[i] -= lambda;
      }
    }
    report.relative_residual = std::sqrt(dot(residual, residual)) / size;
    if (report.relative_residual <= tolerance_.relative_residual) {
      return report;
    }
    if (!(report.relative_residual < worthwhile * before)) {
      break;
    }
  }
  throw NumericalError(fmt::format(
      "{}: relative residual {:.3g} after refinement, more than {:.3g}: the matrix of {} rows is "
      "singular to working precision, or the tolerance is below round-off; check that boundary "
      "conditions fix every unknown, or describe the null space",
      describe(), report.relative_residual, tolerance_.relative_residual, n));
}

}  // namespace hemoscale::micro
