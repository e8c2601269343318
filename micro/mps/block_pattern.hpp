#pragma once

#include <cstddef>
#include <memory>

#include "micro/linear/sparse_matrix.hpp"
#include "micro/mps/node_range.hpp"
#include "micro/particles/neighbour_table.hpp"

namespace hemoscale::micro {

/// Pattern of a system with `block` unknowns per node, numbered node by node, in which every
/// unknown of a node is joined to all unknowns of the node and of its neighbours; the rows of the
/// nodes in `own`.
std::shared_ptr<const SparsePattern> block_pattern(const NeighbourTable& table, int block,
                                                   const NodeRange& own);

/// Writes the rows of one node into the values of a matrix with a block_pattern.
class BlockRow {
 public:
  BlockRow(SparseMatrix& matrix, const NeighbourTable& table, int block, std::size_t node);

  /// Adds to the entry of row `row` of this node and unknown `column` of the neighbour behind the
  /// table entry `entry`.
  void add(int row, std::size_t entry, int column, double value) {
    const std::size_t k = entry - begin_;
    at(row, k < self_ ? k : k + 1, column) += value;
  }

  /// The same for the node's own unknowns.
  void add_own(int row, int column, double value) { at(row, self_, column) += value; }

  /// A difference, weight (phi_j - phi_i), of unknown `column`.
  void add_difference(int row, std::size_t entry, int column, double weight) {
    add(row, entry, column, weight);
    add_own(row, column, -weight);
  }

 private:
  double& at(int row, std::size_t slot, int column) {
    return values_[static_cast<std::size_t>(row) * width_ +
                   slot * static_cast<std::size_t>(block_) + static_cast<std::size_t>(column)];
  }

  double* values_;     // of the first row of the node
  std::size_t width_;  // entries of a row
  std::size_t begin_;  // first table entry of the node
  std::size_t self_;   // neighbours with a lower number than the node
  int block_;
};

}  // namespace hemoscale::micro
