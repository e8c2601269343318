#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "micro/linear/check_finite.hpp"
#include "micro/linear/conjugate_gradient.hpp"
#include "micro/linear/flexible_gmres.hpp"
#include "micro/linear/linear_solver.hpp"
#include "micro/linear/null_space.hpp"
#include "micro/linear/vector_operations.hpp"

namespace hemoscale::micro {

/// What the iterative solvers share: the method by symmetry, the sign, the null space.
struct OuterIteration {
  bool symmetric = false;  // conjugate gradients, else flexible GMRES
  bool negative = false;   // a symmetric matrix is negative definite: its negative is solved
  SolveTolerance tolerance;
  std::optional<ConstantNullSpace> null_space = {};

  /// Solves A x = b, or with a null space P A x = P b, from the guess in x.
  /// @param apply         apply(v, y): y = A v
  /// @param precondition  precondition(r, z): A z = r nearly; r may be overwritten
  /// @throws NumericalError if it does not converge or a value is not finite
  template <class Operator, class Preconditioner>
  SolveReport solve(const Operator& apply, const Preconditioner& precondition,
                    std::span<const double> b, std::span<double> x) const {
    check_finite(b, "right-hand side");
    check_finite(x, "first guess");
    const double size = std::sqrt(dot(b, b));
    if (size == 0) {
      std::fill(x.begin(), x.end(), 0.0);
      return {};
    }
    const auto project = [&](std::span<double> v) {
      if (null_space) {
        remove_mean(*null_space, v);
      }
    };
    const auto turn = [&](std::span<double> v) {
      if (negative) {
        scale(-1, v);
      }
    };
    std::vector<double> right(b.begin(), b.end());
    turn(right);
    project(right);
    project(x);
    const auto outer_apply = [&](std::span<const double> v, std::span<double> y) {
      apply(v, y);
      turn(y);
      project(y);
    };
    std::vector<double> turned(b.size());
    const auto outer_precondition = [&](std::span<const double> r, std::span<double> z) {
      std::copy(r.begin(), r.end(), turned.begin());
      turn(turned);
      precondition(std::span<double>(turned), z);
      project(z);
    };
    const KrylovLimits limits{size, tolerance.relative_residual, tolerance.maximum_iterations};
    return symmetric ? conjugate_gradient(outer_apply, outer_precondition, right, x, limits)
                     : flexible_gmres(outer_apply, outer_precondition, right, x, limits);
  }
};

}  // namespace hemoscale::micro
