#include "micro/ensemble/blocks/block_schedule.hpp"

#include <algorithm>

namespace hemoscale::micro::blocks {

namespace {

std::size_t tiles_of(const ScheduleShape& s) {
  const std::size_t own = s.last - s.first;
  return std::max<std::size_t>(1, (own + s.tile / 2) / s.tile);
}

}  // namespace

std::size_t steps_of_round(const ScheduleShape& s) {
  if (s.last == s.first || s.tile == 0) return 0;
  const std::size_t narrowest = (s.last - s.first) / tiles_of(s);
  return narrowest / (2 * std::max<std::size_t>(1, s.spread));
}

std::vector<BlockTask> tiled_schedule(const ScheduleShape& s, std::size_t steps,
                                      std::size_t round) {
  const std::size_t tiles = tiles_of(s);
  const auto border = [&](std::size_t tile) { return s.first + (s.last - s.first) * tile / tiles; };
  std::vector<BlockTask> tasks;
  tasks.reserve((s.last - s.first) * steps);
  const auto add = [&](std::size_t block, std::size_t step) {
    tasks.push_back(
        {static_cast<std::uint32_t>(block % s.blocks), static_cast<std::uint32_t>(step)});
  };
  for (std::size_t begin = 0; begin < steps; begin += round) {
    const std::size_t count = std::min(round, steps - begin);
    for (std::size_t tile = 0; tile < tiles; ++tile) {
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t last = border(tile + 1) - k * s.spread;
        for (std::size_t b = border(tile) + k * s.spread; b < last; ++b) add(b, begin + k);
      }
    }
    for (std::size_t tile = 0; tile < tiles; ++tile) {
      for (std::size_t k = 1; k < count; ++k) {
        const std::size_t middle = border(tile + 1);
        for (std::size_t b = middle - k * s.spread; b < middle + k * s.spread; ++b) {
          add(b, begin + k);
        }
      }
    }
  }
  return tasks;
}

}  // namespace hemoscale::micro::blocks
