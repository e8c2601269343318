#include "micro/ensemble/blocks/block_parts.hpp"

namespace hemoscale::micro::blocks {

/// Whether no node lies beyond a wall by more than its range.
template <class Real>
bool BlockStepper<Real>::Parts::is_between_walls(const Real* y, std::size_t nodes,
                                                 double frame) const {
  double lowest = 0;
  double highest = 0;
  for (std::size_t i = 0; i < nodes; ++i) {
    lowest = std::min(lowest, static_cast<double>(y[i * width]));
    highest = std::max(highest, static_cast<double>(y[i * width]));
  }
  const auto range = static_cast<double>(walls.range);
  return frame + lowest > -range && frame + highest < static_cast<double>(walls.height) + range;
}

template <class Real>
void BlockStepper<Real>::Parts::centre_block(BlockStore<Real>& store, std::int64_t step,
                                             std::size_t number) {
  const auto parity = static_cast<std::size_t>(step % 2);
  for (std::size_t place = number * width; place < (number + 1) * width; ++place) {
    if (store.ids[place] == no_cell) continue;
    const auto& block = store.blocks[place / width];
    const std::size_t n = store.nodes_of_block(place / width);
    Real* const x = store.x.data() + block.first_value + place % width;
    Real* const y = store.y.data() + block.first_value + place % width;
    double sum_x = 0;
    double sum_y = 0;
    for (std::size_t i = 0; i < n; ++i) {
      sum_x += static_cast<double>(x[i * width]);
      sum_y += static_cast<double>(y[i * width]);
    }
    if (settings.plane_walls && !is_between_walls(y, n, store.frames[parity][place].y())) {
      broken[place] = 1;
    }
    const Vector<2> middle = Vector<2>(sum_x, sum_y) / static_cast<double>(n);
    if (std::abs(middle.x()) < allowed_drift && std::abs(middle.y()) < allowed_drift) continue;
    const auto dx = static_cast<Real>(middle.x());
    const auto dy = static_cast<Real>(middle.y());
    store.frames[parity][place] += Vector<2>(static_cast<double>(dx), static_cast<double>(dy));
    for (std::size_t i = 0; i < n; ++i) {
      x[i * width] -= dx;
      y[i * width] -= dy;
    }
  }
}

template <class Real>
void BlockStepper<Real>::Parts::set_flow(const BlockStore<Real>& store, std::int64_t step,
                                         double time, std::size_t block) {
  const double dt = settings.time_step;
  const std::vector<Vector<2>>& frames = store.frames[static_cast<std::size_t>(step % 2)];
  Real* const rows = flow.data() + block * flow_rows * width;
  for (std::size_t lane = 0; lane < width; ++lane) {
    const std::size_t place = block * width + lane;
    if (store.ids[place] == no_cell) continue;
    const LocalFlow local = settings.flow->at(frames[place] * micrometre, time);
    velocity[place] = local.velocity * (dt / micrometre);
    for (std::size_t k = 0; k < 2; ++k) {
      drift[(2 * block + k) * width + lane] =
          static_cast<Real>(velocity[place][static_cast<Eigen::Index>(k)]);
    }
    const auto set = [&](std::size_t row, double value) {
      rows[row * width + lane] = static_cast<Real>(value);
    };
    for (std::size_t k = 0; k < 4; ++k) {
      set(k,
          dt * local.gradient(static_cast<Eigen::Index>(k / 2), static_cast<Eigen::Index>(k % 2)));
    }
    for (std::size_t k = 0; k < 2; ++k) {
      set(4 + 3 * k, 0.5 * dt * micrometre * local.second[k](0, 0));
      set(5 + 3 * k, dt * micrometre * local.second[k](0, 1));
      set(6 + 3 * k, 0.5 * dt * micrometre * local.second[k](1, 1));
    }
    frame_y[place] = static_cast<Real>(frames[place].y());
  }
}

/// Drift across the flow of the cells of a block in this step, see migration/README.md. A cell
/// whose centre has left the channel has none: its run ends.
template <class Real>
void BlockStepper<Real>::Parts::set_migration(const BlockStore<Real>& store, std::int64_t step,
                                              double time, std::size_t block) {
  const std::vector<Vector<2>>& frames = store.frames[static_cast<std::size_t>(step % 2)];
  const std::size_t n = store.nodes_of_block(block);
  const Real* const y = store.y.data() + store.blocks[block].first_value;
  double sums[width] = {};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t lane = 0; lane < width; ++lane) {
      sums[lane] += static_cast<double>(y[i * width + lane]);
    }
  }
  for (std::size_t lane = 0; lane < width; ++lane) {
    const std::size_t place = block * width + lane;
    if (store.ids[place] == no_cell) continue;
    const Vector<2> centre =
        (frames[place] + Vector<2>(0, sums[lane] / static_cast<double>(n))) * micrometre;
    if (!(centre.y() > 0 && centre.y() < settings.height)) {
      broken[place] = 1;
      migration[place] = 0;
      continue;
    }
    migration[place] = settings.migration.displacement(
                           centre.y(), settings.height, settings.flow->at(centre, time),
                           static_cast<std::uint64_t>(store.ids[place]),
                           static_cast<std::uint64_t>(step), settings.time_step) /
                       micrometre;
  }
}

template <class Real>
void BlockStepper<Real>::Parts::step_block(BlockStore<Real>& store, std::int64_t step, double time,
                                           double image_offset, std::size_t block,
                                           const ContactList& list, Scratch& s) {
  const auto parity = static_cast<std::size_t>(step % 2);
  const std::size_t next = 1 - parity;
  const std::size_t n = store.nodes_of_block(block);
  const std::size_t kind = store.blocks[block].kind;
  const std::size_t values = n * width;
  Real* const forces = s.forces.data();
  std::memset(forces, 0, force_arrays * values * sizeof(Real));
  const std::size_t first_place = block * width;
  const std::size_t b = block - list.first_block;
  if (list.first_active[b + 1] > list.first_active[b]) {
    set_shifts(store, step, periodicity(image_offset), block, list, s.shifts);
    PairArguments<Real> g = pairs[kind];
    g.mirror = store.mirror[parity].data();
    g.active = list.active.data() + list.first_active[b];
    g.active_count = static_cast<std::uint32_t>(list.first_active[b + 1] - list.first_active[b]);
    g.entries = list.entries.data() + list.first_entry[b];
    g.shifts = s.shifts.data();
    g.first_cluster = store.first_cluster.data() + first_place;
    g.nodes = static_cast<int>(n);
    g.force_x = forces;
    g.force_y = forces + values;
    g.stiffness_xx = forces + 2 * values;
    g.stiffness_xy = forces + 3 * values;
    g.stiffness_yy = forces + 4 * values;
    pair_kernel(g);
  }
  BlockArguments<Real> g;
  g.ring = &rings[kind].tables;
  g.walls = walls;
  if (settings.plane_walls) {
    g.walls.stiffness = static_cast<Real>(settings.time_step / settings.kinds[kind].node_drag *
                                          settings.plane_walls->stiffness);
  }
  const std::size_t first = store.blocks[block].first_value;
  g.x = store.x.data() + first;
  g.y = store.y.data() + first;
  if (!store.memory_x.empty()) {
    g.memory_x = store.memory_x.data() + first;
    g.memory_y = store.memory_y.data() + first;
  }
  g.area = store.area.data() + first_place;
  g.frame_y = frame_y.data() + first_place;
  g.flow = flow.data() + block * flow_rows * width;
  g.force_x = forces;
  g.force_y = forces + values;
  g.stiffness_xx = forces + 2 * values;
  g.stiffness_xy = forces + 3 * values;
  g.stiffness_yy = forces + 4 * values;
  g.scratch = s.solver.data();
  g.extremes = extremes.data() + block * 3 * width;
  g.drift = drift.data() + 2 * block * width;
  g.share = velocity_shares.empty() || move == 0 ? share : velocity_shares[kind];
  g.move = move;
  g.stages = stages.data();
  g.stage_count = static_cast<int>(stages.size());
  if (settings.migration.is_any()) set_migration(store, step, time, block);
  kernel(g);
  const double moved = static_cast<double>(move);
  for (std::size_t place = first_place; place < first_place + width; ++place) {
    store.frames[next][place] = store.frames[parity][place] + moved * velocity[place];
    store.frames[next][place].y() += moved * migration[place];
  }
  // The flow of the next step: predictions are relative to the frames that it will move.
  if (changing_flow && move != 0) set_flow(store, step + 1, time_of(step + 1), block);
  write_mirror(store, next, block);
  watch_block(store, block);
}

/// Memory of cells that have just appeared: they move with their frames.
template <class Real>
void BlockStepper<Real>::Parts::expect_drift(BlockStore<Real>& store, std::size_t block) const {
  const std::size_t values = store.nodes_of_block(block) * width;
  const std::size_t first = store.blocks[block].first_value;
  const Real* const rows = drift.data() + 2 * block * width;
  for (std::size_t k = 0; k < values; ++k) {
    store.memory_x[first + k] = rows[k % width];
    store.memory_y[first + k] = rows[width + k % width];
  }
}

/// Mirrors the positions of a block, or those that its next step is expected to reach.
template <class Real>
void BlockStepper<Real>::Parts::write_mirror(BlockStore<Real>& store, std::size_t parity,
                                             std::size_t block) const {
  MirrorArguments<Real> g;
  const std::size_t first = store.blocks[block].first_value;
  g.nodes = static_cast<int>(store.nodes_of_block(block));
  g.x = store.x.data() + first;
  g.y = store.y.data() + first;
  if (predicts) {
    g.add_x = store.memory_x.data() + first;
    g.add_y = store.memory_y.data() + first;
    g.drift = drift.data() + 2 * block * width;
  }
  g.mirror = store.mirror[parity].data();
  g.first_cluster = store.first_cluster.data() + block * width;
  table.mirror(g);
}

template <class Real>
void BlockStepper<Real>::Parts::watch_block(const BlockStore<Real>& store, std::size_t block) {
  const Real* const rows = extremes.data() + block * 3 * width;
  for (std::size_t lane = 0; lane < width; ++lane) {
    const std::size_t place = block * width + lane;
    if (store.ids[place] == no_cell) continue;
    const auto slip = static_cast<double>(rows[2 * width + lane]);
    const auto smallest = static_cast<double>(rows[lane]);
    const auto largest = static_cast<double>(rows[width + lane]);
    travel[place] += std::sqrt(slip) + std::abs(migration[place]);
    longest[place] = std::max(longest[place], 1 / smallest);
    shortest[place] = std::min(shortest[place], 1 / largest);
    // Comparisons that are written so that a number that is none fails them.
    if (!(slip < 1e6 && smallest > 0 && largest < 1e6 &&
          std::abs(static_cast<double>(store.area[place])) < 1e6)) {
      broken[place] = 1;
    }
  }
}

template struct BlockStepper<float>::Parts;
template struct BlockStepper<double>::Parts;

}  // namespace hemoscale::micro::blocks
