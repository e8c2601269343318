#include "micro/linear/null_space.hpp"

#include <fmt/format.h>

#include <cmath>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

// Differences of weights annihilate constants up to round-off, which fits of ill-placed neighbours
// amplify; a pressure that some row fixes misses by parts of one.
constexpr double tolerance = 1e-8;  // [-] of the sum of absolute values of a row

}  // namespace

void check_null_space(const SparseMatrix& matrix, const ConstantNullSpace& null_space) {
  const SparsePattern& pattern = *matrix.pattern;
  if (null_space.stride == 0 || null_space.size(pattern.global_rows) == 0) {
    throw ParameterError(
        fmt::format("null space of unknowns {}, {} + {}, ... holds none of the {} unknowns; first "
                    "must be below that and stride at least 1",
                    null_space.first, null_space.first, null_space.stride, pattern.global_rows));
  }
  double worst = 0;
  std::size_t worst_row = 0;
  for (std::size_t i = 0; i < pattern.rows(); ++i) {
    double sum = 0;
    double magnitude = 0;
    for (auto k = static_cast<std::size_t>(pattern.first[i]);
         k < static_cast<std::size_t>(pattern.first[i + 1]); ++k) {
      const auto column = static_cast<std::size_t>(pattern.columns[k]);
      if (column >= null_space.first && (column - null_space.first) % null_space.stride == 0) {
        sum += matrix.values[k];
        magnitude += std::abs(matrix.values[k]);
      }
    }
    if (std::abs(sum) > worst * magnitude) {
      worst = std::abs(sum) / magnitude;
      worst_row = i;
    }
  }
  if (worst > tolerance) {
    throw NumericalError(fmt::format(
        "constants are no null space of the matrix: row {} maps them to {:.3g} of the sum of its "
        "absolute values, more than {:.0e}; give a null space only where no boundary condition "
        "fixes the unknown",
        pattern.row_begin + worst_row, worst, tolerance));
  }
}

void remove_mean(const ConstantNullSpace& null_space, std::span<double> v) {
  double sum = 0;
  for (std::size_t i = null_space.first; i < v.size(); i += null_space.stride) {
    sum += v[i];
  }
  const double mean = sum / static_cast<double>(null_space.size(v.size()));
  for (std::size_t i = null_space.first; i < v.size(); i += null_space.stride) {
    v[i] -= mean;
  }
}

}  // namespace hemoscale::micro
