#include "micro/ensemble/regions/region_ensemble.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "micro/ensemble/blocks/settings_faults.hpp"
#include "micro/ensemble/regions/cell_bytes.hpp"
#include "micro/ensemble/regions/cell_snapshot.hpp"
#include "micro/ensemble/regions/exchange_interval.hpp"
#include "micro/ensemble/regions/region_run.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {

using namespace blocks;
using namespace regions;

namespace {

// Steps between two looks at the ranks: failures, and cells that have strayed. Counted from step 0,
// so that all that depends on it is the same after a restart.
constexpr std::int64_t steps_between_looks = 256;

using AnyRun = std::variant<std::unique_ptr<RegionRun<float>>, std::unique_ptr<RegionRun<double>>>;

/// Numbers of cells of the ranks before this one, and of all, kind by kind.
struct Numbering {
  std::vector<std::size_t> before;
  std::vector<CellKind> kinds;
};

Numbering number_cells(const BlockSettings& settings, const std::vector<EnsembleState>& part,
                       const RankMessages& messages) {
  std::vector<double> own;
  for (const EnsembleState& state : part) own.push_back(static_cast<double>(state.cells));
  const std::vector<double> all = messages.gather(own);
  Numbering result;
  for (std::size_t kind = 0; kind < part.size(); ++kind) {
    std::size_t cells = 0;
    for (std::size_t rank = 0; rank * part.size() < all.size(); ++rank) {
      if (rank == static_cast<std::size_t>(messages.rank())) result.before.push_back(cells);
      cells += static_cast<std::size_t>(all[rank * part.size() + kind]);
    }
    result.kinds.push_back({settings.kinds[kind].mesh.nodes, cells});
  }
  return result;
}

template <class Real>
std::vector<CellRecord> number_records(const std::vector<EnsembleState>& part,
                                       const Numbering& numbering) {
  std::vector<CellRecord> cells;
  std::size_t first = 0;
  for (std::size_t kind = 0; kind < part.size(); ++kind) {
    const auto more = to_records<Real>(part[kind], static_cast<std::int32_t>(kind),
                                       static_cast<CellId>(first + numbering.before[kind]));
    cells.insert(cells.end(), more.begin(), more.end());
    first += numbering.kinds[kind].cells;
  }
  return cells;
}

}  // namespace

struct RegionEnsemble::Parts {
  BlockSettings settings;
  Precision precision;
  RegionOptions options;
  Communicator communicator;
  RankMessages messages;
  std::vector<CellKind> kinds;
  AnyRun run;
  double start = 0;  // [s] time of step 0
  std::int64_t step = 0;
  double image_offset = 0;  // [m]
  double strain = 0;        // [-] of segments, in the last stretch

  Parts(const BlockSettings& s, Precision p, const RegionOptions& o, const Communicator& c)
      : settings(s),
        precision(p),
        options(o),
        communicator(c.native() == MPI_COMM_NULL ? Communicator() : Communicator(c.native())),
        messages(c) {}

  double time() const { return start + static_cast<double>(step) * settings.time_step; }

  template <class Real>
  void make_run(const std::vector<CellRecord>& cells) {
    auto made = std::make_unique<RegionRun<Real>>(settings, kinds, options, start, messages);
    made->deal(cells, step, image_offset);
    run = std::move(made);
  }
  void make_run(const std::vector<CellRecord>& cells) {
    if (precision == Precision::single) {
      make_run<float>(cells);
    } else {
      make_run<double>(cells);
    }
  }

  /// Cells of all ranks on the root, by number; on the others none.
  std::vector<CellRecord> gather() const {
    std::vector<Message> outgoing(1);
    const auto own = std::visit([&](const auto& r) { return r->cells(step); }, run);
    for (const CellRecord& cell : own) append_cell(outgoing.front().bytes, cell);
    std::vector<CellRecord> cells;
    for (const Message& message : messages.exchange(std::move(outgoing))) {
      read_cells(message.bytes, cells);
    }
    std::sort(cells.begin(), cells.end(),
              [](const CellRecord& a, const CellRecord& b) { return a.id < b.id; });
    return cells;
  }

  /// The same failure on all ranks: that of the first that has one.
  template <class Error>
  void fail_together(const std::string& fault) const {
    for (const std::string& each : communicator.all_gather(fault)) {
      if (!each.empty()) throw Error(each);
    }
  }

  void check(const StretchWatch& watch, double limit) {
    const double own = std::max(watch.largest_stretch, 1 / watch.smallest_stretch) - 1;
    // Written so that a number that is none counts as large.
    const bool failed = !watch.finite || !(own <= limit);
    const std::vector<double> all = messages.gather({own, failed ? 1.0 : 0.0});
    bool any = false;
    for (std::size_t k = 0; k < all.size(); k += 2) {
      strain = std::max(strain, all[k]);
      any = any || all[k + 1] > 0;
    }
    if (!any) return;
    const std::string where =
        fmt::format("step {}, time {:.6g} s, rank {}: ", step, time(), messages.rank());
    std::string fault;
    if (!watch.finite && watch.worst_cell != no_cell) {
      fault = fmt::format(
          "{}a node or the area of cell {} is not finite or out of range; the time "
          "step is {:.4g} s; reduce it, or soften contacts and walls",
          where, watch.worst_cell, settings.time_step);
    } else if (watch.finite && failed) {
      fault = fmt::format(
          "{}a segment of cell {} is stretched or compressed by a factor {:.4g}; at "
          "most {:.4g} is admitted; reduce the time step of {:.4g} s, raise the "
          "stretch modulus or lower the shear rate",
          where, watch.worst_cell, 1 + own, 1 + limit, settings.time_step);
    }
    fail_together<NumericalError>(fault);
  }
};

RegionEnsemble::RegionEnsemble(const BlockSettings& settings, Precision precision,
                               const std::vector<EnsembleState>& part,
                               const Communicator& communicator, const RegionOptions& options) {
  parts_ = std::make_unique<Parts>(settings, precision, options, communicator);
  Parts& p = *parts_;
  std::string faults = settings_faults(settings, part);
  if (options.exchange_interval < 0) {
    faults += fmt::format(
        "{}region ensemble: {} steps between exchanges; give 1 or more, or 0 for "
        "the interval that the error bound allows",
        faults.empty() ? "" : "\n", options.exchange_interval);
  }
  if (!(options.copy_growth >= 1)) {
    faults += fmt::format(
        "{}region ensemble: cells are dealt out anew at {} times the copies; give a "
        "factor of at least 1",
        faults.empty() ? "" : "\n", options.copy_growth);
  }
  p.fail_together<ParameterError>(faults);
  if (options.exchange_interval == 0) {
    p.options.exchange_interval = regions::exchange_interval(settings, options.motion);
  }
  const Numbering numbering = number_cells(settings, part, p.messages);
  p.kinds = numbering.kinds;
  p.start = part.front().time;
  p.image_offset = part.front().image_offset;
  if (precision == Precision::single) {
    p.make_run<float>(number_records<float>(part, numbering));
  } else {
    p.make_run<double>(number_records<double>(part, numbering));
  }
}
RegionEnsemble::~RegionEnsemble() = default;
RegionEnsemble::RegionEnsemble(RegionEnsemble&&) noexcept = default;
RegionEnsemble& RegionEnsemble::operator=(RegionEnsemble&&) noexcept = default;

void RegionEnsemble::advance(std::int64_t steps) {
  Parts& p = *parts_;
  p.strain = 0;
  for (const std::int64_t last = p.step + steps; p.step < last;) {
    const std::int64_t look = (p.step / steps_between_looks + 1) * steps_between_looks;
    const std::int64_t end = std::min(last, look);
    const StretchWatch watch = std::visit(
        [&](auto& run) { return run->advance(p.step, end - p.step, p.start, p.image_offset); },
        p.run);
    p.step = end;
    p.check(watch, segment_strain_limit);
  }
}

std::vector<EnsembleState> RegionEnsemble::states(bool everywhere) const {
  const Parts& p = *parts_;
  std::vector<CellRecord> cells = p.gather();
  if (everywhere && p.messages.size() > 1) {
    std::vector<Message> outgoing;
    std::string bytes;
    for (const CellRecord& cell : cells) append_cell(bytes, cell);
    for (int rank = 1; rank < p.messages.size() && p.messages.rank() == 0; ++rank) {
      outgoing.push_back({rank, bytes});
    }
    for (const Message& message : p.messages.exchange(std::move(outgoing))) {
      read_cells(message.bytes, cells);
    }
  }
  std::vector<EnsembleState> result;
  for (const CellKind& kind : p.kinds) {
    EnsembleState state;
    state.nodes = static_cast<std::size_t>(kind.nodes);
    state.image_offset = p.image_offset;
    state.time = p.time();
    state.step = p.step;
    result.push_back(std::move(state));
  }
  for (const CellRecord& cell : cells) {
    EnsembleState& state = result[static_cast<std::size_t>(cell.kind)];
    ++state.cells;
    for (std::size_t i = 0; i < state.nodes; ++i) {
      state.x.push_back((cell.frame.x() + cell.x[i]) * micrometre);
      state.y.push_back((cell.frame.y() + cell.y[i]) * micrometre);
    }
  }
  return result;
}

Snapshot RegionEnsemble::snapshot() const {
  const Parts& p = *parts_;
  const std::vector<CellRecord> cells = p.gather();
  if (p.messages.rank() != 0) return {};
  return to_snapshot(cells, {p.step, p.start, p.image_offset});
}

void RegionEnsemble::restore(const Snapshot& snapshot) {
  Parts& p = *parts_;
  std::string fault;
  SnapshotClock clock;
  std::vector<CellRecord> cells;
  if (p.messages.rank() == 0) {
    try {
      cells = from_snapshot(snapshot, p.kinds, clock);
    } catch (const ParameterError& error) {
      fault = error.what();
    }
  }
  p.fail_together<ParameterError>(fault);
  const std::vector<double> reals =
      p.messages.gather({static_cast<double>(clock.step), clock.start, clock.image_offset});
  p.step = static_cast<std::int64_t>(reals[0]);
  p.start = reals[1];
  p.image_offset = reals[2];
  p.make_run(cells);
}

double RegionEnsemble::time() const {
  return parts_->time();
}
std::int64_t RegionEnsemble::step() const {
  return parts_->step;
}
double RegionEnsemble::image_offset() const {
  return parts_->image_offset;
}
double RegionEnsemble::largest_segment_strain() const {
  return parts_->strain;
}
const BlockSettings& RegionEnsemble::settings() const {
  return parts_->settings;
}
std::int64_t RegionEnsemble::exchange_interval() const {
  return parts_->options.exchange_interval;
}
const StepCounters& RegionEnsemble::counters() const {
  return std::visit([](const auto& run) -> const StepCounters& { return run->counters(); },
                    parts_->run);
}
RegionCounters RegionEnsemble::region_counters() const {
  return std::visit([](const auto& run) { return run->region_counters(); }, parts_->run);
}
const char* RegionEnsemble::kernel_version() const {
  return kernels<float>().name;
}

std::vector<EnsembleState> part_of_rank(const std::vector<EnsembleState>& whole,
                                        const Communicator& communicator) {
  const auto ranks = static_cast<std::size_t>(communicator.size());
  const auto rank = static_cast<std::size_t>(communicator.rank());
  std::vector<EnsembleState> parts;
  for (const EnsembleState& state : whole) {
    const auto first = static_cast<std::ptrdiff_t>(state.cells * rank / ranks * state.nodes);
    const auto last = static_cast<std::ptrdiff_t>(state.cells * (rank + 1) / ranks * state.nodes);
    EnsembleState part = state;
    part.cells = static_cast<std::size_t>(last - first) / state.nodes;
    part.x.assign(state.x.begin() + first, state.x.begin() + last);
    part.y.assign(state.y.begin() + first, state.y.begin() + last);
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace hemoscale::micro
