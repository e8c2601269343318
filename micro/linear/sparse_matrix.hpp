#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace hemoscale::micro {

/// Non-zeros of consecutive rows of a square matrix in compressed rows; columns ascend within a row
/// and the diagonal is present. A rank of a distributed system holds the rows [row_begin, row_begin
/// + rows()); a serial one holds all.
struct SparsePattern {
  std::vector<std::int64_t> first = {0};  // entries of local row i: [first[i], first[i + 1])
  std::vector<std::int32_t> columns;      // global
  std::size_t row_begin = 0;              // global number of the first local row
  std::size_t global_rows = 0;            // rows of the whole system

  std::size_t rows() const { return first.size() - 1; }
  bool is_whole() const { return rows() == global_rows; }

  /// Position of an entry in `columns` and `values`, by its local row and global column.
  /// @pre the pattern holds the entry (assertion)
  std::size_t entry(std::size_t row, std::int32_t column) const;
};

/// Values on a fixed pattern, which several matrices share.
struct SparseMatrix {
  std::shared_ptr<const SparsePattern> pattern;
  std::vector<double> values;

  SparseMatrix() = default;
  explicit SparseMatrix(std::shared_ptr<const SparsePattern> shape)
      : pattern(std::move(shape)), values(pattern->columns.size(), 0.0) {}

  std::size_t rows() const { return pattern->rows(); }
};

/// y = A x for the rows that `matrix` holds; rows are shared among threads and each is summed in
/// the order of its columns, so that any number of threads gives the same bits.
/// @param x  global_rows() values
/// @param y  rows() values
void multiply(const SparseMatrix& matrix, std::span<const double> x, std::span<double> y);

/// Sum of a[i] b[i] in blocks of fixed length: same bits for any number of threads.
double dot(std::span<const double> a, std::span<const double> b);

}  // namespace hemoscale::micro
