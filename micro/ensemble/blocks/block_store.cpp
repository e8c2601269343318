#include "micro/ensemble/blocks/block_store.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemoscale::micro::blocks {
namespace {

constexpr std::size_t reals_per_cluster = 8;

/// A circle that a place without a cell carries, so that kernels meet no zero lengths. Nobody reads
/// it, and no list holds it.
Vector<2> idle_node(std::size_t node, std::size_t nodes) {
  const double angle =
      2 * std::numbers::pi * static_cast<double>(node) / static_cast<double>(nodes);
  return {3 * std::cos(angle), 3 * std::sin(angle)};
}

template <class Real>
double polygon_area(const Real* x, const Real* y, std::size_t nodes, std::size_t stride) {
  double sum = 0;
  for (std::size_t i = 0; i < nodes; ++i) {
    const std::size_t a = i * stride;
    const std::size_t b = (i + 1 == nodes ? 0 : i + 1) * stride;
    sum += static_cast<double>(x[a]) * static_cast<double>(y[b]) -
           static_cast<double>(x[b]) * static_cast<double>(y[a]);
  }
  return 0.5 * sum;
}

}  // namespace

template <class Real>
BlockStore<Real> make_store(const std::vector<CellKind>& kinds,
                            const std::vector<CellRecord>& cells, std::size_t ids, bool memory,
                            std::size_t parity) {
  constexpr std::size_t width = BlockStore<Real>::width;
  BlockStore<Real> store;
  store.kinds = kinds;
  store.place_of_id.assign(ids, -1);
  std::vector<std::vector<const CellRecord*>> of_kind(kinds.size());
  for (const CellRecord& cell : cells) {
    of_kind[static_cast<std::size_t>(cell.kind)].push_back(&cell);
  }
  std::size_t values = 0;
  std::uint32_t clusters = 0;
  std::vector<const CellRecord*> at_place;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    const auto nodes = static_cast<std::size_t>(kinds[kind].nodes);
    const std::size_t blocks = (of_kind[kind].size() + width - 1) / width;
    for (std::size_t b = 0; b < blocks; ++b) {
      store.blocks.push_back({kind, values});
      values += nodes * width;
      for (std::size_t lane = 0; lane < width; ++lane) {
        const std::size_t k = b * width + lane;
        at_place.push_back(k < of_kind[kind].size() ? of_kind[kind][k] : nullptr);
        store.first_cluster.push_back(clusters);
        store.kind_of_place.push_back(static_cast<std::int32_t>(kind));
        clusters += static_cast<std::uint32_t>(store.clusters_of_kind(kind));
      }
    }
  }
  store.x.resize(values);
  store.y.resize(values);
  if (memory) {
    store.memory_x.assign(values, 0);
    store.memory_y.assign(values, 0);
    store.memory_is_new = std::all_of(cells.begin(), cells.end(),
                                      [](const CellRecord& cell) { return cell.memory_x.empty(); });
  }
  store.area.resize(store.places());
  store.ids.assign(store.places(), no_cell);
  for (std::size_t p = 0; p < 2; ++p) {
    store.mirror[p].assign(clusters * reals_per_cluster, static_cast<Real>(1e5));
    store.frames[p].assign(store.places(), Vector<2>::Zero());
  }
  for (std::size_t place = 0; place < store.places(); ++place) {
    const auto& block = store.blocks[place / width];
    const auto nodes = static_cast<std::size_t>(kinds[block.kind].nodes);
    const std::size_t first = block.first_value + place % width;
    const CellRecord* const cell = at_place[place];
    if (cell != nullptr) {
      store.ids[place] = cell->id;
      store.place_of_id[static_cast<std::size_t>(cell->id)] = static_cast<std::int32_t>(place);
      store.frames[parity][place] = cell->frame;
    }
    Real* const mirror =
        store.mirror[parity].data() + reals_per_cluster * store.first_cluster[place];
    for (std::size_t i = 0; i < nodes; ++i) {
      const Vector<2> idle = idle_node(i, nodes);
      const Real x = static_cast<Real>(cell != nullptr ? cell->x[i] : idle.x());
      const Real y = static_cast<Real>(cell != nullptr ? cell->y[i] : idle.y());
      store.x[first + i * width] = x;
      store.y[first + i * width] = y;
      mirror[reals_per_cluster * (i / 4) + i % 4] = x;
      mirror[reals_per_cluster * (i / 4) + 4 + i % 4] = y;
      if (memory && cell != nullptr && !cell->memory_x.empty()) {
        store.memory_x[first + i * width] = static_cast<Real>(cell->memory_x[i]);
        store.memory_y[first + i * width] = static_cast<Real>(cell->memory_y[i]);
      }
    }
    store.area[place] = static_cast<Real>(
        cell != nullptr && cell->area
            ? *cell->area
            : polygon_area(store.x.data() + first, store.y.data() + first, nodes, width));
  }
  return store;
}

template <class Real>
CellRecord read_cell(const BlockStore<Real>& store, std::size_t place, std::size_t parity) {
  constexpr std::size_t width = BlockStore<Real>::width;
  const auto& block = store.blocks[place / width];
  const auto nodes = static_cast<std::size_t>(store.kinds[block.kind].nodes);
  const std::size_t first = block.first_value + place % width;
  CellRecord cell;
  cell.id = store.ids[place];
  cell.kind = static_cast<std::int32_t>(block.kind);
  cell.frame = store.frames[parity][place];
  const auto copy = [&](const AlignedArray<Real>& from, std::vector<double>& to) {
    if (from.empty()) {
      return;
    }
    to.resize(nodes);
    for (std::size_t i = 0; i < nodes; ++i) {
      to[i] = static_cast<double>(from[first + i * width]);
    }
  };
  cell.area = static_cast<double>(store.area[place]);
  copy(store.x, cell.x);
  copy(store.y, cell.y);
  copy(store.memory_x, cell.memory_x);
  copy(store.memory_y, cell.memory_y);
  return cell;
}

template <class Real>
std::vector<CellRecord> to_records(const EnsembleState& state, std::int32_t kind, CellId first_id) {
  std::vector<CellRecord> cells(state.cells);
  for (std::size_t c = 0; c < state.cells; ++c) {
    CellRecord& cell = cells[c];
    cell.id = first_id + static_cast<CellId>(c);
    cell.kind = kind;
    for (std::size_t i = c * state.nodes; i < (c + 1) * state.nodes; ++i) {
      cell.frame += Vector<2>(state.x[i], state.y[i]);
    }
    cell.frame /= static_cast<double>(state.nodes) * micrometre;
    for (std::size_t i = c * state.nodes; i < (c + 1) * state.nodes; ++i) {
      cell.x.push_back(
          static_cast<double>(static_cast<Real>(state.x[i] / micrometre - cell.frame.x())));
      cell.y.push_back(
          static_cast<double>(static_cast<Real>(state.y[i] / micrometre - cell.frame.y())));
    }
  }
  return cells;
}

template struct BlockStore<float>;
template struct BlockStore<double>;
template BlockStore<float> make_store<float>(const std::vector<CellKind>&,
                                             const std::vector<CellRecord>&, std::size_t, bool,
                                             std::size_t);
template BlockStore<double> make_store<double>(const std::vector<CellKind>&,
                                               const std::vector<CellRecord>&, std::size_t, bool,
                                               std::size_t);
template CellRecord read_cell<float>(const BlockStore<float>&, std::size_t, std::size_t);
template CellRecord read_cell<double>(const BlockStore<double>&, std::size_t, std::size_t);
template std::vector<CellRecord> to_records<float>(const EnsembleState&, std::int32_t, CellId);
template std::vector<CellRecord> to_records<double>(const EnsembleState&, std::int32_t, CellId);

}  // namespace hemoscale::micro::blocks
