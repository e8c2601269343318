#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hemoscale::micro::blocks {

/// One step of one block.
struct BlockTask {
  std::uint32_t block = 0;
  std::uint32_t step = 0;  // of the leg, from 0
};

/// Blocks on a circle, of which a thread owns [first, last). A block sees others up to `spread`
/// numbers away, and needs them as far as it is itself.
struct ScheduleShape {
  std::size_t first = 0, last = 0;
  std::size_t blocks = 0;  // on the circle
  std::size_t spread = 0;
  std::size_t tile = 0;  // blocks whose data fit into the cache
};

/// Steps by which the tiles of a thread can be advanced before any of them becomes empty.
std::size_t steps_of_round(const ScheduleShape& shape);

/// The tasks of a thread in an order in which blocks stay in the cache for several steps: tiles of
/// blocks are advanced by as many steps as their middles can be without their neighbours (the
/// blocks that are advanced become fewer from either side, by `spread` each step), then the gaps
/// between the tiles, which widen by as much. The gap at its upper end belongs to a thread, and
/// reaches into the blocks of the next.
///
/// Every task of all threads appears once, and threads that take theirs in this order, each waiting
/// for what it needs, all come to the end.
///
/// @param steps  of the leg
/// @param round  [steps] for which tiles are advanced at a time, the same for all threads: at most
///               the steps_of_round of any
std::vector<BlockTask> tiled_schedule(const ScheduleShape& shape, std::size_t steps,
                                      std::size_t round);

}  // namespace hemoscale::micro::blocks
