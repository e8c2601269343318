#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "micro/linear/direct_solver.hpp"

namespace hemoscale::micro {

/// General sparse factorisations of Eigen, for shapes without a narrow band: LDL^T without pivoting
/// (approximate minimum degree order) of symmetric definite matrices, else LU with partial pivoting
/// (column approximate minimum degree order). The order is found once for a pattern.
class SparseDirectSolver final : public DirectSolver {
 public:
  /// @param symmetric  promises symmetric, definite matrices: only their lower triangle is read
  explicit SparseDirectSolver(bool symmetric, const SolveTolerance& tolerance = {},
                              std::optional<ConstantNullSpace> null_space = {});
  ~SparseDirectSolver() override;

  std::string describe() const override;

 private:
  void factor(const SparseMatrix& scaled, bool same_pattern) override;
  void back_substitute(std::span<double> v) const override;
  bool is_symmetric() const override { return symmetric_; }

  struct Factors;  // hides Eigen's templates
  bool symmetric_;
  std::unique_ptr<Factors> factors_;
};

}  // namespace hemoscale::micro
