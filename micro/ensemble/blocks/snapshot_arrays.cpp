#include "micro/ensemble/blocks/snapshot_arrays.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "micro/error.hpp"

namespace hemoscale::micro::blocks {

void set_arrays(Snapshot& snapshot, const std::vector<CellRecord>& cells) {
  auto& frames = snapshot.reals["blocks.frames"];
  auto& area = snapshot.reals["blocks.area"];
  auto& x = snapshot.reals["blocks.x"];
  auto& y = snapshot.reals["blocks.y"];
  auto& memory_x = snapshot.reals["blocks.memory_x"];
  auto& memory_y = snapshot.reals["blocks.memory_y"];
  for (const CellRecord& cell : cells) {
    frames.insert(frames.end(), {cell.frame.x(), cell.frame.y()});
    area.push_back(*cell.area);
    x.insert(x.end(), cell.x.begin(), cell.x.end());
    y.insert(y.end(), cell.y.begin(), cell.y.end());
    memory_x.insert(memory_x.end(), cell.memory_x.begin(), cell.memory_x.end());
    memory_y.insert(memory_y.end(), cell.memory_y.begin(), cell.memory_y.end());
  }
}

const std::vector<double>& finite_reals(const Snapshot& snapshot, const std::string& name,
                                        std::size_t size) {
  const auto found = snapshot.reals.find(name);
  const bool fits = found != snapshot.reals.end() && found->second.size() == size;
  if (!fits || !std::all_of(found->second.begin(), found->second.end(),
                            [](double v) { return std::isfinite(v); })) {
    throw ParameterError(fmt::format(
        "snapshot: no {} finite numbers '{}'; one of an ensemble with the same parameters is "
        "needed; restore it into the kind of model that wrote it",
        size, name));
  }
  return found->second;
}

}  // namespace hemoscale::micro::blocks
