#include "micro/linear/galerkin.hpp"

#include <algorithm>

namespace hemoscale::micro {
namespace {

// A row that grows by scattered additions; `slot` finds the place of a column in it.
class ScatterRow {
 public:
  explicit ScatterRow(std::size_t columns) : slot_(columns, -1) {}

  void add(std::int32_t column, double value) {
    std::int32_t& slot = slot_[static_cast<std::size_t>(column)];
    if (slot < 0) {
      slot = static_cast<std::int32_t>(columns_.size());
      columns_.push_back(column);
      values_.push_back(value);
    } else {
      values_[static_cast<std::size_t>(slot)] += value;
    }
  }

  // Appends the row, and empties it.
  void flush(std::vector<std::int32_t>& columns, std::vector<double>& values, bool sorted) {
    if (sorted) {
      order_ = columns_;
      std::sort(order_.begin(), order_.end());
      for (const std::int32_t column : order_) {
        columns.push_back(column);
        values.push_back(
            values_[static_cast<std::size_t>(slot_[static_cast<std::size_t>(column)])]);
      }
    } else {
      columns.insert(columns.end(), columns_.begin(), columns_.end());
      values.insert(values.end(), values_.begin(), values_.end());
    }
    for (const std::int32_t column : columns_) {
      slot_[static_cast<std::size_t>(column)] = -1;
    }
    columns_.clear();
    values_.clear();
  }

 private:
  std::vector<std::int32_t> slot_;  // -1: not in the row
  std::vector<std::int32_t> columns_, order_;
  std::vector<double> values_;
};

}  // namespace

SparseMatrix galerkin_product(const SparseMatrix& matrix, std::span<const double> rows,
                              const Interpolation& p) {
  const SparsePattern& pattern = *matrix.pattern;
  ScatterRow row(p.coarse_size());
  // A P, row by row.
  std::vector<std::size_t> half_first = {0};
  std::vector<std::int32_t> half_columns;
  std::vector<double> half_values;
  for (std::size_t i = 0; i < pattern.rows(); ++i) {
    const double factor = rows.empty() ? 1 : rows[i];
    for (auto k = static_cast<std::size_t>(pattern.first[i]);
         k < static_cast<std::size_t>(pattern.first[i + 1]); ++k) {
      const auto j = static_cast<std::size_t>(pattern.columns[k]);
      const double value = factor * matrix.values[k];
      for (auto c = static_cast<std::size_t>(p.first[j]);
           c < static_cast<std::size_t>(p.first[j + 1]); ++c) {
        row.add(p.coarse[c], value * static_cast<double>(p.weight[c]));
      }
    }
    row.flush(half_columns, half_values, false);
    half_first.push_back(half_columns.size());
  }
  // P^T (A P).
  auto coarse = std::make_shared<SparsePattern>();
  coarse->global_rows = p.coarse_size();
  std::vector<double> values;
  for (std::size_t j = 0; j < p.coarse_size(); ++j) {
    row.add(static_cast<std::int32_t>(j), 0);
    for (auto c = static_cast<std::size_t>(p.coarse_first[j]);
         c < static_cast<std::size_t>(p.coarse_first[j + 1]); ++c) {
      const auto i = static_cast<std::size_t>(p.fine[c]);
      const auto weight = static_cast<double>(p.coarse_weight[c]);
      for (std::size_t k = half_first[i]; k < half_first[i + 1]; ++k) {
        row.add(half_columns[k], weight * half_values[k]);
      }
    }
    row.flush(coarse->columns, values, true);
    coarse->first.push_back(static_cast<std::int64_t>(values.size()));
  }
  SparseMatrix product(coarse);
  product.values = std::move(values);
  return product;
}

}  // namespace hemoscale::micro
