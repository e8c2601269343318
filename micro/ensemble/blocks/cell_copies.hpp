#pragma once

#include <cstddef>
#include <vector>

#include "micro/ensemble/blocks/block_store.hpp"

namespace hemoscale::micro::blocks {

/// A cell that another rank advances.
struct CopiedCell {
  CellId id = no_cell;
  std::int32_t kind = 0;
};

/// Makes room beyond the places of the blocks for copies of the given cells, in the given order;
/// what was there is gone. Their mirrors and frames are to be filled by the caller, in both
/// buffers.
template <class Real>
void set_copies(BlockStore<Real>& store, const std::vector<CopiedCell>& cells);

template <class Real>
std::size_t count_copies(const BlockStore<Real>& store) {
  return store.ids.size() - store.places();
}

/// Copies are carried in groups of as many as a block has cells.
template <class Real>
std::size_t count_copy_groups(const BlockStore<Real>& store) {
  constexpr std::size_t width = BlockStore<Real>::width;
  return (count_copies(store) + width - 1) / width;
}

}  // namespace hemoscale::micro::blocks
