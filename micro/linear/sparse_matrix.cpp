#include "micro/linear/sparse_matrix.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace hemoscale::micro {
namespace {

constexpr std::size_t block_length =
    4096;                         // of the partial sums: fixed, so that threads do not show
constexpr std::size_t lanes = 8;  // independent sums that the compiler can keep in vectors

// Below this many rows starting threads costs more than the work.
constexpr std::size_t worth_threads = 8192;

double block_dot(const double* a, const double* b, std::size_t n) {
  std::array<double, lanes> sums = {};
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes) {
    for (std::size_t k = 0; k < lanes; ++k) {
      sums[k] += a[i + k] * b[i + k];
    }
  }
  for (std::size_t k = 0; i < n; ++i, ++k) {
    sums[k] += a[i] * b[i];
  }
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

}  // namespace

std::size_t SparsePattern::entry(std::size_t row, std::int32_t column) const {
  assert(row < rows());
  const auto begin = columns.begin() + first[row];
  const auto end = columns.begin() + first[row + 1];
  const auto found = std::lower_bound(begin, end, column);
  assert(found != end && *found == column);
  return static_cast<std::size_t>(found - columns.begin());
}

void multiply(const SparseMatrix& matrix, std::span<const double> x, std::span<double> y) {
  const SparsePattern& pattern = *matrix.pattern;
  assert(x.size() == pattern.global_rows && y.size() == pattern.rows());
  const std::int64_t* first = pattern.first.data();
  const std::int32_t* columns = pattern.columns.data();
  const double* values = matrix.values.data();
  const std::size_t rows = pattern.rows();
#pragma omp parallel for schedule(static) if (rows > worth_threads)
  for (std::size_t i = 0; i < rows; ++i) {
    double sum = 0;
    for (std::int64_t k = first[i]; k < first[i + 1]; ++k) {
      sum += values[k] * x[static_cast<std::size_t>(columns[k])];
    }
    y[i] = sum;
  }
}

double dot(std::span<const double> a, std::span<const double> b) {
  assert(a.size() == b.size());
  const std::size_t blocks = (a.size() + block_length - 1) / block_length;
  if (blocks <= 1) {
    return block_dot(a.data(), b.data(), a.size());
  }
  std::vector<double> partial(blocks);
#pragma omp parallel for schedule(static) if (a.size() > worth_threads)
  for (std::size_t k = 0; k < blocks; ++k) {
    const std::size_t begin = k * block_length;
    partial[k] =
        block_dot(a.data() + begin, b.data() + begin, std::min(block_length, a.size() - begin));
  }
  double sum = 0;
  for (const double each : partial) {
    sum += each;
  }
  return sum;
}

}  // namespace hemoscale::micro
