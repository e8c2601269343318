#pragma once

#include <cstddef>
#include <vector>

#include "micro/ensemble/blocks/block_store.hpp"
#include "micro/ensemble/blocks/contact_list.hpp"
#include "micro/ensemble/regions/rank_messages.hpp"

namespace hemoscale::micro::regions {

/// A rank with cells near own ones.
struct Neighbourhood {
  int rank = 0;
  std::vector<std::size_t> sent;         // own places whose cells the rank needs copies of
  std::vector<blocks::CellId> received;  // cells of the rank, in the order in which it sends them
  std::vector<std::int32_t> received_kinds;
};

/// Cells of other ranks whose boxes are nearer than `range` to those of own cells, and own cells
/// that are near theirs. Collective.
///
/// Every rank tells all the box round its cells; ranks whose boxes are near exchange the boxes of
/// the cells in question, and both find the same pairs from the same numbers.
/// @param parity  buffer that holds the present positions
/// @param range   [um]
/// @param middle  [um] of the own region
template <class Real>
std::vector<Neighbourhood> find_neighbourhoods(const blocks::BlockStore<Real>& store,
                                               std::size_t parity,
                                               const blocks::Periodicity& periodicity, double range,
                                               const Vector<2>& middle,
                                               const RankMessages& messages);

}  // namespace hemoscale::micro::regions
