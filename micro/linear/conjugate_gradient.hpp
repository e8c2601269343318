#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "micro/linear/linear_solver.hpp"
#include "micro/linear/restart_watch.hpp"
#include "micro/linear/sparse_matrix.hpp"
#include "micro/linear/vector_operations.hpp"

namespace hemoscale::micro {

/// Preconditioned conjugate gradients [HestenesStiefel1952] for symmetric positive definite A and
/// M, or semi-definite A if b, and what the two functors return, lie in its range.
///
/// The residual of the recursion drifts from b - A x by round-off: at its convergence the true one
/// is computed, and the iteration starts anew from there should it be larger than wanted.
///
/// @param apply         apply(v, y): y = A v
/// @param precondition  precondition(r, z): z = M^-1 r
/// @throws NumericalError on breakdown (A or M not positive definite, values not finite),
///         stagnation or too many iterations
template <class Operator, class Preconditioner>
SolveReport conjugate_gradient(const Operator& apply, const Preconditioner& precondition,
                               std::span<const double> b, std::span<double> x,
                               const KrylovLimits& limits) {
  constexpr const char* method = "conjugate gradients";
  const std::size_t n = b.size();
  std::vector<double> r(n), z(n), p(n), q(n);
  RestartWatch watch(method, limits);
  while (true) {
    apply(x, std::span<double>(q));
    subtract(b, q, r);
    double size = std::sqrt(dot(r, r));
    if (watch.is_done(size)) {
      return watch.report;
    }
    double product = 0;  // r.z
    bool started = false;
    while (!watch.is_reached(size)) {
      watch.count(size);
      precondition(std::span<const double>(r), std::span<double>(z));
      const double next =
          watch.require_positive(dot(r, z), "the preconditioner is not positive definite", size);
      if (started) {
        combine(z, next / product, p);
      } else {
        p = z;
      }
      started = true;
      product = next;
      apply(std::span<const double>(p), std::span<double>(q));
      const double length =
          product / watch.require_positive(dot(p, q), "the matrix is not positive definite", size);
      add(length, p, x);
      add(-length, q, r);
      size = std::sqrt(dot(r, r));
    }
  }
}

}  // namespace hemoscale::micro
