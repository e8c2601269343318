#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "micro/ensemble/box.hpp"
#include "micro/ensemble/packing/cell_room.hpp"
#include "micro/ensemble/state.hpp"

namespace hemoscale::micro {

/// Number of nodes that lie inside another cell, or inside another image of their own. Cost per
/// cell does not depend on their number.
std::size_t count_interpenetrating_nodes(const EnsembleState& state, const Box& box);

/// The same for cells of several kinds.
std::size_t count_interpenetrating_nodes(std::span<const EnsembleState> kinds,
                                         const CellRoom& room);

}  // namespace hemoscale::micro
