#include "micro/mps/block_pattern.hpp"

#include <algorithm>

namespace hemoscale::micro {

namespace {

std::size_t lower_neighbours(const NeighbourTable& table, std::size_t node) {
  const auto row = table.of(node);
  return static_cast<std::size_t>(
      std::lower_bound(row.begin(), row.end(), static_cast<std::int32_t>(node)) - row.begin());
}

}  // namespace

std::shared_ptr<const SparsePattern> block_pattern(const NeighbourTable& table, int block,
                                                   const NodeRange& own) {
  const auto unknowns = static_cast<std::size_t>(block);
  auto pattern = std::make_shared<SparsePattern>();
  const std::size_t nodes = table.size();
  pattern->global_rows = nodes * unknowns;
  pattern->row_begin = own.begin * unknowns;
  pattern->first.resize(own.size() * unknowns + 1);
  const std::size_t pairs = own.size() > 0 ? table.end(own.end - 1) - table.begin(own.begin) : 0;
  pattern->columns.resize((pairs + own.size()) * unknowns * unknowns);
#pragma omp parallel for schedule(static)
  for (std::size_t i = own.begin; i < own.end; ++i) {
    const std::size_t self = lower_neighbours(table, i);
    const std::size_t width = (table.end(i) - table.begin(i) + 1) * unknowns;
    const std::size_t local = i - own.begin;
    std::size_t position = (table.begin(i) - table.begin(own.begin) + local) * unknowns * unknowns;
    for (std::size_t row = 0; row < unknowns; ++row) {
      pattern->first[local * unknowns + row] = static_cast<std::int64_t>(position);
      for (std::size_t slot = 0; slot < width / unknowns; ++slot) {
        const std::size_t node = slot == self  ? i
                                 : slot < self ? table[table.begin(i) + slot]
                                               : table[table.begin(i) + slot - 1];
        for (std::size_t c = 0; c < unknowns; ++c) {
          pattern->columns[position++] = static_cast<std::int32_t>(node * unknowns + c);
        }
      }
    }
  }
  pattern->first.back() = static_cast<std::int64_t>(pattern->columns.size());
  return pattern;
}

BlockRow::BlockRow(SparseMatrix& matrix, const NeighbourTable& table, int block, std::size_t node)
    : values_(matrix.values.data() + matrix.pattern->first[node * static_cast<std::size_t>(block) -
                                                           matrix.pattern->row_begin]),
      width_((table.end(node) - table.begin(node) + 1) * static_cast<std::size_t>(block)),
      begin_(table.begin(node)),
      self_(lower_neighbours(table, node)),
      block_(block) {}

}  // namespace hemoscale::micro
