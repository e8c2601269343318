#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "micro/linear/restart_watch.hpp"
#include "micro/linear/sparse_matrix.hpp"
#include "micro/linear/vector_operations.hpp"

namespace hemoscale::micro {

/// Flexible GMRES [Saad1993], preconditioned from the right by an M that may change from step to
/// step, for A of any kind. The residual never grows; two vectors are kept for every step up to the
/// restart.
///
/// @param restart  steps between restarts, at least one
/// @throws NumericalError on values that are not finite, stagnation over a whole restart or too
/// many
///         iterations
template <class Operator, class Preconditioner>
SolveReport flexible_gmres(const Operator& apply, const Preconditioner& precondition,
                           std::span<const double> b, std::span<double> x,
                           const KrylovLimits& limits, std::size_t restart = 30) {
  const std::size_t n = b.size();
  RestartWatch watch("GMRES", limits);
  std::vector<std::vector<double>> basis(1, std::vector<double>(n)), steps;
  std::vector<double> product(n);
  while (true) {
    apply(x, std::span<double>(product));
    subtract(b, product, basis[0]);
    double size = std::sqrt(dot(basis[0], basis[0]));
    if (watch.is_done(size)) {
      return watch.report;
    }
    scale(1 / size, basis[0]);
    // Columns of the Hessenberg matrix, made triangular by rotations as they come.
    std::vector<std::vector<double>> columns;
    std::vector<double> cosines, sines, right = {size};
    while (columns.size() < restart && !watch.is_reached(size)) {
      watch.count(size);
      const std::size_t k = columns.size();
      if (steps.size() == k) {
        steps.emplace_back(n);
        basis.emplace_back(n);
      }
      precondition(std::span<const double>(basis[k]), std::span<double>(steps[k]));
      std::vector<double>& next = basis[k + 1];
      apply(std::span<const double>(steps[k]), std::span<double>(next));
      std::vector<double> column(k + 1);
      for (std::size_t i = 0; i <= k; ++i) {
        column[i] = dot(next, basis[i]);
        add(-column[i], basis[i], next);
      }
      const double below = std::sqrt(dot(next, next));
      for (std::size_t i = 0; i < k; ++i) {
        const double upper = cosines[i] * column[i] + sines[i] * column[i + 1];
        column[i + 1] = cosines[i] * column[i + 1] - sines[i] * column[i];
        column[i] = upper;
      }
      const double length =
          watch.require_nonzero(std::hypot(column[k], below), "breakdown: A is singular", size);
      cosines.push_back(column[k] / length);
      sines.push_back(below / length);
      column[k] = length;
      right.push_back(-sines[k] * right[k]);
      right[k] *= cosines[k];
      columns.push_back(std::move(column));
      size = std::abs(right[k + 1]);
      if (below > 0) {
        scale(1 / below, next);
      }
    }
    std::vector<double> lengths(columns.size());
    for (std::size_t k = columns.size(); k-- > 0;) {
      double sum = right[k];
      for (std::size_t j = k + 1; j < columns.size(); ++j) {
        sum -= columns[j][k] * lengths[j];
      }
      lengths[k] = sum / columns[k][k];
    }
    for (std::size_t k = 0; k < columns.size(); ++k) {
      add(lengths[k], steps[k], x);
    }
  }
}

}  // namespace hemoscale::micro
