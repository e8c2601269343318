#include "micro/ensemble/blocks/block_ensemble.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "micro/ensemble/blocks/block_limits.hpp"
#include "micro/ensemble/blocks/settings_faults.hpp"
#include "micro/ensemble/blocks/snapshot_arrays.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {

using namespace blocks;

namespace {

template <class Real>
struct BlockRun {
  BlockStore<Real> store;
  BlockStepper<Real> stepper;
};

/// Nodes of all cells of all kinds, in the order of their numbers.
std::size_t count_cells(const std::vector<EnsembleState>& states) {
  std::size_t n = 0;
  for (const EnsembleState& state : states) n += state.cells;
  return n;
}

/// Whether the second state of a node is its displacement in the last step; or else what rounding
/// dropped.
bool remembers_motion(Integrator integrator) {
  switch (integrator) {
    case Integrator::constant_operator:
    case Integrator::constant_operator_second_order:
    case Integrator::inertial:
      return true;
    case Integrator::explicit_euler:
    case Integrator::linearly_implicit:
    case Integrator::chebyshev:
      return false;
  }
  return false;
}

}  // namespace

struct BlockEnsemble::Parts {
  BlockSettings settings;
  std::vector<CellKind> kinds;
  std::variant<BlockRun<float>, BlockRun<double>> run;
  double start = 0;  // [s] time of step 0
  std::int64_t step = 0;
  double image_offset = 0;               // [m]
  double strain = 0;                     // [-] of segments, in the last stretch
  std::vector<std::int32_t> kind_of_id;  // of all cells that were ever there

  Parts(const BlockSettings& s, Precision precision, const std::vector<EnsembleState>& initial)
      : settings(s), kinds(kinds_of(initial)), run(make_run(s, precision, initial, kinds)) {
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      kind_of_id.insert(kind_of_id.end(), kinds[k].cells, static_cast<std::int32_t>(k));
    }
  }

  static std::vector<CellKind> kinds_of(const std::vector<EnsembleState>& initial) {
    std::vector<CellKind> kinds;
    for (const EnsembleState& state : initial) {
      kinds.push_back({static_cast<int>(state.nodes), state.cells});
    }
    return kinds;
  }

  static std::vector<CellRecord> in_order(const BlockSettings& s, std::vector<CellRecord> cells) {
    const bool along = exceed_cache(s, cells.size());
    std::sort(cells.begin(), cells.end(), [&](const CellRecord& a, const CellRecord& b) {
      return order_of_cell(a, a.frame, along) < order_of_cell(b, b.frame, along);
    });
    return cells;
  }

  template <class Real>
  static BlockRun<Real> make(const BlockSettings& s, const std::vector<EnsembleState>& initial,
                             const std::vector<CellKind>& kinds) {
    std::vector<CellRecord> cells;
    for (std::size_t k = 0; k < initial.size(); ++k) {
      const auto more = to_records<Real>(initial[k], static_cast<std::int32_t>(k),
                                         static_cast<CellId>(cells.size()));
      cells.insert(cells.end(), more.begin(), more.end());
    }
    return {make_store<Real>(kinds, in_order(s, std::move(cells)), count_cells(initial),
                             has_memory(s.integrator), 0),
            BlockStepper<Real>(s)};
  }
  static std::variant<BlockRun<float>, BlockRun<double>> make_run(
      const BlockSettings& s, Precision precision, const std::vector<EnsembleState>& initial,
      const std::vector<CellKind>& kinds) {
    if (precision == Precision::single) return make<float>(s, initial, kinds);
    return make<double>(s, initial, kinds);
  }

  double time() const { return start + static_cast<double>(step) * settings.time_step; }
  std::size_t parity() const { return static_cast<std::size_t>(step % 2); }

  const std::vector<std::int32_t>& places() const {
    return std::visit(
        [](const auto& r) -> const std::vector<std::int32_t>& { return r.store.place_of_id; }, run);
  }
  bool is_present(CellId id) const {
    return id >= 0 && static_cast<std::size_t>(id) < places().size() &&
           places()[static_cast<std::size_t>(id)] >= 0;
  }
  /// Before the first step nothing has set the memory of any cell.
  bool memory_is_new() const {
    return std::visit([](const auto& r) { return r.store.memory_is_new; }, run);
  }
  CellRecord record(CellId id) const {
    const auto place = static_cast<std::size_t>(places()[static_cast<std::size_t>(id)]);
    CellRecord cell =
        std::visit([&](const auto& r) { return read_cell(r.store, place, parity()); }, run);
    if (memory_is_new()) {
      cell.memory_x.clear();
      cell.memory_y.clear();
    }
    return cell;
  }
  /// Numbers of the cells that are there, kind after kind, ascending.
  std::vector<std::vector<CellId>> present() const {
    std::vector<std::vector<CellId>> ids(kinds.size());
    for (std::size_t id = 0; id < places().size(); ++id) {
      if (places()[id] < 0) continue;
      ids[static_cast<std::size_t>(kind_of_id[id])].push_back(static_cast<CellId>(id));
    }
    return ids;
  }
  /// All cells but those that a mark names.
  std::vector<CellRecord> records_without(const std::vector<bool>& is_left_out) const {
    std::vector<CellRecord> records;
    for (std::size_t id = 0; id < places().size(); ++id) {
      if (places()[id] >= 0 && !is_left_out[id]) records.push_back(record(static_cast<CellId>(id)));
    }
    return records;
  }
  /// The second state of a cell that has just come: it moves with the flow at its frame, and
  /// nothing was lost in rounding.
  void set_memory(CellRecord& cell) const {
    Vector<2> moved = Vector<2>::Zero();
    if (remembers_motion(settings.integrator)) {
      moved = settings.flow->at(cell.frame * micrometre, time()).velocity *
              (settings.time_step / micrometre);
    }
    cell.memory_x.assign(cell.x.size(), moved.x());
    cell.memory_y.assign(cell.y.size(), moved.y());
  }
  /// Puts these cells in the place of all that are there.
  void replace(std::vector<CellRecord> records) {
    for (CellKind& kind : kinds) kind.cells = 0;
    for (const CellRecord& r : records) ++kinds[static_cast<std::size_t>(r.kind)].cells;
    const std::vector<CellRecord> ordered = in_order(settings, std::move(records));
    std::visit(
        [&](auto& r) {
          using Store = std::decay_t<decltype(r.store)>;
          r.store = make_store<std::conditional_t<Store::width == 16, float, double>>(
              kinds, ordered, kind_of_id.size(), has_memory(settings.integrator), parity());
          r.stepper.invalidate();
        },
        run);
  }
};

BlockEnsemble::BlockEnsemble(const BlockSettings& settings, Precision precision,
                             const std::vector<EnsembleState>& initial) {
  std::string faults = settings_faults(settings, initial);
  if (faults.empty() && precision == Precision::single && !settings.force) {
    faults = single_precision_fault(settings);
  }
  if (!faults.empty()) throw ParameterError(faults);
  parts_ = std::make_unique<Parts>(settings, precision, initial);
  parts_->start = initial.front().time;
  parts_->image_offset = initial.front().image_offset;
}
BlockEnsemble::~BlockEnsemble() = default;
BlockEnsemble::BlockEnsemble(BlockEnsemble&&) noexcept = default;
BlockEnsemble& BlockEnsemble::operator=(BlockEnsemble&&) noexcept = default;

void BlockEnsemble::advance(std::int64_t steps) {
  Parts& p = *parts_;
  const StretchWatch watch = std::visit(
      [&](auto& run) {
        return run.stepper.advance(run.store, p.step, steps, p.start, p.image_offset);
      },
      p.run);
  p.step += steps;
  p.strain = std::max(watch.largest_stretch, 1 / watch.smallest_stretch) - 1;
  if (!watch.finite) {
    throw NumericalError(fmt::format(
        "step {}, time {:.6g} s: a node or the area of cell {} is not finite, or out of "
        "range, as beyond a wall by more than its range; the time step is {:.4g} s; reduce it, or "
        "soften contacts and walls",
        p.step, p.time(), watch.worst_cell, p.settings.time_step));
  }
  if (!(p.strain <= segment_strain_limit)) {
    throw NumericalError(
        fmt::format("step {}, time {:.6g} s: a segment of cell {} is stretched or compressed by a "
                    "factor {:.4g}; at most {:.4g} is admitted; reduce the time step of {:.4g} s, "
                    "raise the stretch modulus or lower the shear rate",
                    p.step, p.time(), watch.worst_cell, 1 + p.strain, 1 + segment_strain_limit,
                    p.settings.time_step));
  }
}

std::vector<EnsembleState> BlockEnsemble::states() const {
  const Parts& p = *parts_;
  const std::vector<std::vector<CellId>> ids = p.present();
  std::vector<EnsembleState> result;
  for (std::size_t k = 0; k < p.kinds.size(); ++k) {
    EnsembleState state;
    state.cells = p.kinds[k].cells;
    state.nodes = static_cast<std::size_t>(p.kinds[k].nodes);
    state.x.reserve(state.cells * state.nodes);
    state.y.reserve(state.cells * state.nodes);
    state.image_offset = p.image_offset;
    state.time = p.time();
    state.step = p.step;
    for (const CellId id : ids[k]) {
      const CellRecord cell = p.record(id);
      for (std::size_t i = 0; i < state.nodes; ++i) {
        state.x.push_back((cell.frame.x() + cell.x[i]) * micrometre);
        state.y.push_back((cell.frame.y() + cell.y[i]) * micrometre);
      }
    }
    result.push_back(std::move(state));
  }
  return result;
}

std::vector<std::vector<CellId>> BlockEnsemble::identities() const {
  return parts_->present();
}

std::vector<std::vector<Vector<2>>> BlockEnsemble::frames() const {
  const Parts& p = *parts_;
  std::vector<std::vector<Vector<2>>> result(p.kinds.size());
  std::visit(
      [&](const auto& run) {
        for (std::size_t id = 0; id < p.places().size(); ++id) {
          if (p.places()[id] < 0) continue;
          const auto place = static_cast<std::size_t>(p.places()[id]);
          result[static_cast<std::size_t>(p.kind_of_id[id])].push_back(
              run.store.frames[p.parity()][place] * micrometre);
        }
      },
      p.run);
  return result;
}

std::vector<Vector<2>> BlockEnsemble::nodes_of(CellId cell) const {
  if (!parts_->is_present(cell)) {
    throw ParameterError(fmt::format(
        "block ensemble: cell {} is not there; ask for one that identities() lists", cell));
  }
  const CellRecord record = parts_->record(cell);
  std::vector<Vector<2>> nodes;
  for (std::size_t i = 0; i < record.x.size(); ++i) {
    nodes.push_back((record.frame + Vector<2>(record.x[i], record.y[i])) * micrometre);
  }
  return nodes;
}

std::vector<CellId> BlockEnsemble::exchange(const std::vector<CellId>& leaving,
                                            const std::vector<EnsembleState>& entering) {
  Parts& p = *parts_;
  std::vector<bool> is_left_out(p.places().size(), false);
  for (const CellId id : leaving) {
    if (!p.is_present(id) || is_left_out[static_cast<std::size_t>(id)]) {
      throw ParameterError(fmt::format(
          "block ensemble: cell {} is to be removed, but is not there or named twice; {} numbers "
          "were given so far; name cells that identities() lists, once",
          id, p.kind_of_id.size()));
    }
    is_left_out[static_cast<std::size_t>(id)] = true;
  }
  const std::string faults = settings_faults(p.settings, entering);
  if (!faults.empty()) throw ParameterError(faults);
  std::vector<CellRecord> records = p.records_without(is_left_out);
  std::vector<CellId> numbers;
  for (std::size_t k = 0; k < entering.size(); ++k) {
    const auto kind = static_cast<std::int32_t>(k);
    const auto first = static_cast<CellId>(p.kind_of_id.size());
    std::vector<CellRecord> more = p.run.index() == 0
                                       ? to_records<float>(entering[k], kind, first)
                                       : to_records<double>(entering[k], kind, first);
    for (CellRecord& cell : more) {
      if (has_memory(p.settings.integrator) && !p.memory_is_new()) p.set_memory(cell);
      numbers.push_back(cell.id);
      p.kind_of_id.push_back(kind);
      records.push_back(std::move(cell));
    }
  }
  p.replace(std::move(records));
  return numbers;
}

double BlockEnsemble::time() const {
  return parts_->time();
}
std::int64_t BlockEnsemble::step() const {
  return parts_->step;
}
double BlockEnsemble::image_offset() const {
  return parts_->image_offset;
}
double BlockEnsemble::largest_segment_strain() const {
  return parts_->strain;
}
const BlockSettings& BlockEnsemble::settings() const {
  return parts_->settings;
}
const StepCounters& BlockEnsemble::counters() const {
  return std::visit([](const auto& run) -> const StepCounters& { return run.stepper.counters(); },
                    parts_->run);
}
const char* BlockEnsemble::kernel_version() const {
  return kernels<float>().name;
}

Snapshot BlockEnsemble::snapshot() const {
  const Parts& p = *parts_;
  Snapshot s;
  s.integers["blocks.step"] = {p.step};
  s.integers["blocks.numbers_given"] = {static_cast<std::int64_t>(p.kind_of_id.size())};
  s.reals["blocks.time"] = {p.start, p.image_offset};
  auto& ids = s.integers["blocks.ids"];
  auto& kinds = s.integers["blocks.kinds"];
  std::vector<CellRecord> cells;
  for (std::size_t id = 0; id < p.places().size(); ++id) {
    if (p.places()[id] < 0) continue;
    cells.push_back(p.record(static_cast<CellId>(id)));
    ids.push_back(cells.back().id);
    kinds.push_back(cells.back().kind);
  }
  set_arrays(s, cells);
  return s;
}

void BlockEnsemble::restore(const Snapshot& snapshot) {
  Parts& p = *parts_;
  const auto reals = [&](const char* name, std::size_t size) -> const std::vector<double>& {
    return finite_reals(snapshot, name, size);
  };
  const auto integers = [&](const char* name) -> const std::vector<std::int64_t>& {
    static const std::vector<std::int64_t> none;
    const auto array = snapshot.integers.find(name);
    return array == snapshot.integers.end() ? none : array->second;
  };
  const auto& step = integers("blocks.step");
  const auto& given = integers("blocks.numbers_given");
  const auto& ids = integers("blocks.ids");
  const auto& kinds = integers("blocks.kinds");
  bool fits = step.size() == 1 && step.front() >= 0 && given.size() == 1 &&
              kinds.size() == ids.size() && given.front() >= std::ssize(ids);
  std::size_t values = 0;
  for (std::size_t k = 0; fits && k < ids.size(); ++k) {
    fits = ids[k] >= (k == 0 ? 0 : ids[k - 1] + 1) && ids[k] < given.front() && kinds[k] >= 0 &&
           kinds[k] < std::ssize(p.kinds);
    if (fits) values += static_cast<std::size_t>(p.kinds[static_cast<std::size_t>(kinds[k])].nodes);
  }
  if (!fits) {
    throw ParameterError(
        "snapshot: step, numbers or kinds of cells are not those of such an ensemble; restore it "
        "into a model with the same parameters");
  }
  const auto found = snapshot.reals.find("blocks.memory_x");
  const bool memory_is_new = found != snapshot.reals.end() && found->second.empty();
  const std::size_t memory = has_memory(p.settings.integrator) && !memory_is_new ? values : 0;
  const auto& frames = reals("blocks.frames", 2 * ids.size());
  const auto& area = reals("blocks.area", ids.size());
  const auto& x = reals("blocks.x", values);
  const auto& y = reals("blocks.y", values);
  const auto& memory_x = reals("blocks.memory_x", memory);
  const auto& memory_y = reals("blocks.memory_y", memory);
  const auto& time = reals("blocks.time", 2);
  std::vector<CellRecord> records(ids.size());
  p.kind_of_id.assign(static_cast<std::size_t>(given.front()), -1);
  std::size_t first = 0;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    CellRecord& cell = records[k];
    cell.id = static_cast<CellId>(ids[k]);
    cell.kind = static_cast<std::int32_t>(kinds[k]);
    p.kind_of_id[static_cast<std::size_t>(cell.id)] = cell.kind;
    const auto n = static_cast<std::size_t>(p.kinds[static_cast<std::size_t>(cell.kind)].nodes);
    cell.frame = {frames[2 * k], frames[2 * k + 1]};
    cell.area = area[k];
    const auto part = [&](const std::vector<double>& all) {
      return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(first),
                                 all.begin() + static_cast<std::ptrdiff_t>(first + n));
    };
    cell.x = part(x);
    cell.y = part(y);
    if (memory > 0) {
      cell.memory_x = part(memory_x);
      cell.memory_y = part(memory_y);
    }
    first += n;
  }
  p.step = step.front();
  p.start = time[0];
  p.image_offset = time[1];
  p.replace(std::move(records));
}

}  // namespace hemoscale::micro
