#include "micro/immersed/membrane_snapshot.hpp"

#include <fmt/format.h>

#include "micro/error.hpp"
#include "micro/particles/particle_snapshot.hpp"

namespace hemoscale::micro {

namespace {

template <typename Value>
const std::vector<Value>& find(const std::map<std::string, std::vector<Value>>& arrays,
                               const char* name, std::size_t size) {
  const auto found = arrays.find(name);
  if (found == arrays.end() || found->second.size() != size) {
    throw ParameterError(fmt::format(
        "snapshot: {} numbers '{}' where {} are needed; restore it into a model of the same cells",
        found == arrays.end() ? std::size_t{0} : found->second.size(), name, size));
  }
  return found->second;
}

}  // namespace

void store_cells(const std::vector<Cell>& cells, Snapshot& snapshot) {
  std::vector<Vector<2>> positions;
  std::vector<Vector<2>> velocities;
  std::vector<std::int64_t>& counts = snapshot.integers["cells.nodes"];
  for (const Cell& cell : cells) {
    positions.insert(positions.end(), cell.positions.begin(), cell.positions.end());
    velocities.insert(velocities.end(), cell.velocities.begin(), cell.velocities.end());
    counts.push_back(static_cast<std::int64_t>(cell.positions.size()));
  }
  snapshot.reals["cells.positions"] = flat<2>(positions);
  snapshot.reals["cells.velocities"] = flat<2>(velocities);
}

void load_cells(const Snapshot& snapshot, std::vector<Cell>& cells) {
  const std::vector<std::int64_t>& counts = find(snapshot.integers, "cells.nodes", cells.size());
  std::size_t total = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::size_t nodes = cells[c].positions.size();
    if (counts[c] != static_cast<std::int64_t>(nodes)) {
      throw ParameterError(fmt::format(
          "snapshot: cell {} has {} nodes where {} are needed; restore it into a model of the same "
          "cells",
          c, counts[c], nodes));
    }
    total += nodes;
  }
  const auto positions = vectors_of<2>(find(snapshot.reals, "cells.positions", 2 * total));
  const auto velocities = vectors_of<2>(find(snapshot.reals, "cells.velocities", 2 * total));
  std::size_t at = 0;
  for (Cell& cell : cells) {
    cell.velocities.resize(cell.positions.size());
    for (std::size_t i = 0; i < cell.positions.size(); ++i, ++at) {
      cell.positions[i] = positions[at];
      cell.velocities[i] = velocities[at];
    }
  }
}

const std::vector<double>& stored_reals(const Snapshot& snapshot, const char* name,
                                        std::size_t size) {
  return find(snapshot.reals, name, size);
}

const std::vector<std::int64_t>& stored_integers(const Snapshot& snapshot, const char* name,
                                                 std::size_t size) {
  return find(snapshot.integers, name, size);
}

}  // namespace hemoscale::micro
