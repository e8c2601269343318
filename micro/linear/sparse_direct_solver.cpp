#include "micro/linear/sparse_direct_solver.hpp"

#include <fmt/format.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <cstdint>

#include "micro/error.hpp"

namespace hemoscale::micro {

struct SparseDirectSolver::Factors {
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int32_t>;
  Matrix matrix;  // of LU the transposed rows as columns; of LDL^T the lower triangle
  Eigen::SparseLU<Matrix, Eigen::COLAMDOrdering<std::int32_t>> lu;
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<std::int32_t>> ldlt;
};

SparseDirectSolver::SparseDirectSolver(bool symmetric, const SolveTolerance& tolerance,
                                       std::optional<ConstantNullSpace> null_space)
    : DirectSolver(tolerance, null_space),
      symmetric_(symmetric),
      factors_(std::make_unique<Factors>()) {}

SparseDirectSolver::~SparseDirectSolver() = default;

void SparseDirectSolver::factor(const SparseMatrix& scaled, bool same_pattern) {
  const SparsePattern& pattern = *scaled.pattern;
  const auto n = static_cast<Eigen::Index>(pattern.rows());
  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;
  Rows rows(n, n);
  rows.reserve(static_cast<Eigen::Index>(pattern.columns.size()));
  for (std::size_t i = 0; i < pattern.rows(); ++i) {
    rows.startVec(static_cast<Eigen::Index>(i));
    for (auto k = static_cast<std::size_t>(pattern.first[i]);
         k < static_cast<std::size_t>(pattern.first[i + 1]); ++k) {
      if (!symmetric_ || pattern.columns[k] <= static_cast<std::int32_t>(i)) {
        rows.insertBack(static_cast<Eigen::Index>(i), pattern.columns[k]) = scaled.values[k];
      }
    }
  }
  rows.finalize();
  factors_->matrix = rows;
  const auto fail = [&](const std::string& reason) {
    throw NumericalError(fmt::format(
        "{}: the matrix is singular{}; check that boundary conditions fix every unknown, or "
        "describe the null space",
        describe(), reason.empty() ? "" : ": " + reason));
  };
  if (symmetric_) {
    if (!same_pattern) {
      factors_->ldlt.analyzePattern(factors_->matrix);
    }
    factors_->ldlt.factorize(factors_->matrix);
    if (factors_->ldlt.info() != Eigen::Success) {
      fail("zero pivot");
    }
  } else {
#ifndef __clang_analyzer__  // it imagines matrices without rows, which prepare refuses, inside
                            // Eigen
    if (!same_pattern) {
      factors_->lu.analyzePattern(factors_->matrix);
    }
    factors_->lu.factorize(factors_->matrix);
#endif
    if (factors_->lu.info() != Eigen::Success) {
      fail(factors_->lu.lastErrorMessage());
    }
  }
}

void SparseDirectSolver::back_substitute(std::span<double> v) const {
  Eigen::Map<Eigen::VectorXd> values(v.data(), static_cast<Eigen::Index>(v.size()));
  if (symmetric_) {
    values = factors_->ldlt.solve(values).eval();
  } else {
    values = factors_->lu.solve(values).eval();
  }
}

std::string SparseDirectSolver::describe() const {
  return fmt::format("sparse {}, {} unknowns",
                     symmetric_ ? "LDL^T (minimum degree)" : "LU (column minimum degree)",
                     unknowns());
}

}  // namespace hemoscale::micro
