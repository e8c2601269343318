#include "micro/linear/check_finite.hpp"

#include <fmt/format.h>

#include <cmath>

#include "micro/error.hpp"

namespace hemoscale::micro {

void check_finite(const SparseMatrix& matrix) {
  const SparsePattern& pattern = *matrix.pattern;
  for (std::size_t i = 0; i < pattern.rows(); ++i) {
    for (auto k = static_cast<std::size_t>(pattern.first[i]);
         k < static_cast<std::size_t>(pattern.first[i + 1]); ++k) {
      if (!std::isfinite(matrix.values[k])) {
        throw NumericalError(fmt::format(
            "matrix entry ({}, {}) is {}; look for coinciding nodes or an earlier blow-up",
            pattern.row_begin + i, pattern.columns[k], matrix.values[k]));
      }
    }
  }
}

void check_finite(std::span<const double> values, const char* name) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      throw NumericalError(
          fmt::format("{}: value {} is {}; look for an earlier blow-up", name, i, values[i]));
    }
  }
}

}  // namespace hemoscale::micro
