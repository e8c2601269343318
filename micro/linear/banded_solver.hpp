#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "micro/linear/direct_solver.hpp"
#include "micro/linear/ordering.hpp"

namespace hemoscale::micro {

/// Banded factorisations of LAPACK in a given order of the unknowns: LU with partial pivoting
/// (dgbtrf, dgbtrs), or Cholesky (dpbtrf, dpbtrs) of symmetric definite matrices of either sign.
///
/// With kl entries below and ku above the diagonal LU takes n (2 kl + ku + 1) values of memory and
/// 2 n kl (kl + ku) operations, Cholesky n (kl + 1) and n kl^2. In channels the order by columns
/// makes this the fastest solver up to medium size, and pivoting makes it safe for indefinite
/// systems.
///
/// OpenBLAS is told, for the whole process, to use one thread: its own threads would change the
/// last bits with their number, and the samples and rows are shared among threads already.
class BandedSolver final : public DirectSolver {
 public:
  /// @param symmetric  promises symmetric, definite matrices: only their lower triangle is read
  explicit BandedSolver(Ordering ordering, const SolveTolerance& tolerance = {},
                        std::optional<ConstantNullSpace> null_space = {}, bool symmetric = false);

  std::string describe() const override;

 private:
  void factor(const SparseMatrix& scaled, bool same_pattern) override;
  void back_substitute(std::span<double> v) const override;
  bool is_symmetric() const override { return symmetric_; }

  void fill(const SparseMatrix& scaled);
  void measure_fill();
  double& band_entry(std::size_t row, std::size_t column);

  Ordering ordering_;
  bool symmetric_;
  double sign_ = 1;           // [-] of a definite matrix
  std::size_t leading_ = 0;   // [-] values stored a column
  std::vector<double> band_;  // column by column, as LAPACK wants it
  std::vector<std::int32_t> pivots_;
  // What the factorisation has filled of each column of LU, above and below the diagonal.
  std::vector<std::int32_t> heights_, depths_;
  mutable std::vector<double> ordered_;  // scratch: the vector in the order of the band
};

}  // namespace hemoscale::micro
