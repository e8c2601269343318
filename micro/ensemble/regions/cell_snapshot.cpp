#include "micro/ensemble/regions/cell_snapshot.hpp"

#include "micro/ensemble/blocks/snapshot_arrays.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro::regions {

using blocks::CellId;
using blocks::CellKind;
using blocks::CellRecord;
using blocks::finite_reals;

Snapshot to_snapshot(const std::vector<CellRecord>& cells, const SnapshotClock& clock) {
  Snapshot s;
  s.integers["blocks.step"] = {clock.step};
  s.reals["blocks.time"] = {clock.start, clock.image_offset};
  blocks::set_arrays(s, cells);
  auto& nodes = s.integers["blocks.nodes"];
  for (const CellRecord& cell : cells) nodes.push_back(static_cast<std::int64_t>(cell.x.size()));
  return s;
}

std::vector<CellRecord> from_snapshot(const Snapshot& snapshot, const std::vector<CellKind>& kinds,
                                      SnapshotClock& clock) {
  std::vector<std::int32_t> kind_of_cell;
  std::vector<std::int64_t> expected;
  std::size_t values = 0;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    kind_of_cell.insert(kind_of_cell.end(), kinds[kind].cells, static_cast<std::int32_t>(kind));
    expected.insert(expected.end(), kinds[kind].cells, kinds[kind].nodes);
    values += kinds[kind].cells * static_cast<std::size_t>(kinds[kind].nodes);
  }
  const std::size_t cells = kind_of_cell.size();
  const auto& frames = finite_reals(snapshot, "blocks.frames", 2 * cells);
  const auto& area = finite_reals(snapshot, "blocks.area", cells);
  const auto& time = finite_reals(snapshot, "blocks.time", 2);
  const auto step = snapshot.integers.find("blocks.step");
  const auto nodes = snapshot.integers.find("blocks.nodes");
  if (step == snapshot.integers.end() || step->second.size() != 1 || step->second.front() < 0 ||
      nodes == snapshot.integers.end() || nodes->second != expected) {
    throw ParameterError(
        "snapshot: step or nodes are not those of such an ensemble; restore it into a model with "
        "the same parameters");
  }
  const auto memory = snapshot.reals.find("blocks.memory_x");
  const bool has_memory = memory != snapshot.reals.end() && !memory->second.empty();
  const std::vector<double>* const from[4] = {
      &finite_reals(snapshot, "blocks.x", values), &finite_reals(snapshot, "blocks.y", values),
      &finite_reals(snapshot, "blocks.memory_x", has_memory ? values : 0),
      &finite_reals(snapshot, "blocks.memory_y", has_memory ? values : 0)};
  clock = {step->second.front(), time[0], time[1]};
  std::vector<CellRecord> records(cells);
  std::size_t first = 0;
  for (std::size_t id = 0; id < cells; ++id) {
    CellRecord& cell = records[id];
    cell.id = static_cast<CellId>(id);
    cell.kind = kind_of_cell[id];
    cell.frame = {frames[2 * id], frames[2 * id + 1]};
    cell.area = area[id];
    const auto last = first + static_cast<std::size_t>(expected[id]);
    std::vector<double>* const to[4] = {&cell.x, &cell.y, &cell.memory_x, &cell.memory_y};
    for (std::size_t k = 0; k < (has_memory ? 4U : 2U); ++k) {
      to[k]->assign(from[k]->begin() + static_cast<std::ptrdiff_t>(first),
                    from[k]->begin() + static_cast<std::ptrdiff_t>(last));
    }
    first = last;
  }
  return records;
}

}  // namespace hemoscale::micro::regions
