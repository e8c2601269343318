#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "micro/linear/lattice_interpolation.hpp"
#include "micro/linear/linear_solver.hpp"
#include "micro/linear/sparse_matrix.hpp"

namespace hemoscale::micro {

/// One V-cycle of a multigrid method on lattices over the nodes, as a preconditioner z = M^-1 r.
///
/// Smoothing by the Chebyshev polynomials of the fourth kind [Lottes2023] in D^-1 A, before and
/// after the correction from the next coarser lattice, whose matrix is P^T A P; the coarsest system
/// is factored. Of a symmetric matrix M is symmetric. Nothing depends on the number of threads:
/// every row is a sum of its own.
///
/// All in single precision, which halves the memory that a cycle reads; an outer iteration in
/// double precision does not notice.
class Multigrid {
 public:
  /// How much smoothing.
  struct Smoothing {
    int fine = 2;    // [-] degree of the polynomial on the nodes
    int coarse = 3;  // [-] and on the lattices
  };

  /// @param interpolations  from every lattice to the next finer level, finest first
  Multigrid(std::vector<Interpolation> interpolations, const Smoothing& smoothing);
  ~Multigrid();
  Multigrid(Multigrid&&) noexcept;
  Multigrid& operator=(Multigrid&&) noexcept;

  /// @param rows           factor of every row of the matrix, after which the diagonal is positive
  /// @param constant_null  constants are a null space
  void prepare(const SparseMatrix& matrix, std::span<const double> rows, bool symmetric,
               bool constant_null);

  /// z = M^-1 r, r already multiplied by the factors of its rows.
  void apply(std::span<const double> r, std::span<double> z) const;

  std::size_t levels() const;
  std::size_t coarsest_size() const;

 private:
  struct Level;
  void cycle(std::size_t number) const;

  std::vector<Interpolation> interpolations_;
  Smoothing smoothing_;
  std::vector<std::unique_ptr<Level>> levels_;
  std::unique_ptr<LinearSolver> coarsest_;
  mutable std::vector<double> coarsest_r_, coarsest_x_;
};

}  // namespace hemoscale::micro
