#pragma once

#include "micro/ensemble/box.hpp"
#include "micro/ensemble/state.hpp"

namespace hemoscale::micro {

/// Number of nodes that lie inside another cell, or inside another image of their own.
/// Cost: nodes times cells whose bounding boxes hold them.
std::size_t count_interpenetrating_nodes(const EnsembleState& state, const Box& box);

}  // namespace hemoscale::micro
