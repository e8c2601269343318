#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "micro/ensemble/packing/cell_room.hpp"
#include "micro/ensemble/state.hpp"

namespace hemoscale::micro {

/// Two cells that are not apart.
struct Overlap {
  std::size_t kind = 0, cell = 0;              // number within its kind
  std::size_t other_kind = 0, other_cell = 0;  // the same for an image of itself
  bool crosses = false;  // outlines cross, whether or not a node lies inside; or else one cell lies
                         // wholly inside the other
  Vector<2> place = Vector<2>::Zero();  // [m] of a crossing, or of the inner cell
};

/// Every pair of cells, or of a cell and an image, that overlap. Two outlines that are apart and
/// not one inside the other do not cross: nothing is missed, also where corners interlock without a
/// node inside. Cost per cell does not depend on their number: 60 ns per node.
/// @param kinds  states in the same coordinates
std::vector<Overlap> overlaps(std::span<const EnsembleState> kinds, const CellRoom& room);

/// What is wrong with a state before a run: lines with kind, cell, place and remedy, for the first
/// few of each fault and a count of all; empty if nothing is. Looks for nodes that are not finite,
/// nodes beyond a wall, cells that have left through an opening, and overlaps.
std::vector<std::string> state_faults(std::span<const EnsembleState> kinds, const CellRoom& room);

/// @throws ParameterError with all lines of state_faults
void require_sound(std::span<const EnsembleState> kinds, const CellRoom& room);

}  // namespace hemoscale::micro
