#pragma once

#include <mpi.h>

#include <memory>
#include <span>

#include "micro/linear/sparse_matrix.hpp"

namespace hemoscale::micro {

/// One V-cycle of hypre's BoomerAMG, z = M^-1 r, on the rows of all ranks of a communicator.
class BoomerAmg {
 public:
  /// Collective.
  /// @param rows      factor of every local row
  /// @param singular  the matrix has a null space: the coarsest level is smoothed, not factored
  /// @throws NumericalError with hypre's reason
  BoomerAmg(MPI_Comm communicator, const SparseMatrix& matrix, std::span<const double> rows,
            bool singular);
  ~BoomerAmg();
  BoomerAmg(const BoomerAmg&) = delete;
  BoomerAmg& operator=(const BoomerAmg&) = delete;

  /// Collective.
  /// @param r, z  local rows
  void apply(std::span<const double> r, std::span<double> z) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace hemoscale::micro
