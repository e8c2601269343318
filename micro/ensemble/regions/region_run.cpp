#include "micro/ensemble/regions/region_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "micro/ensemble/blocks/cell_copies.hpp"
#include "micro/ensemble/regions/cell_bytes.hpp"

namespace hemoscale::micro::regions {

using namespace blocks;

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t steps_between_looks = 256;  // at how blocks have been sheared
double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

/// The two longest travels of all, in the order (longest, second, whether a number is not finite).
void join_watches(void* from, void* into, int* count, MPI_Datatype*) {
  const auto* a = static_cast<const double*>(from);
  auto* b = static_cast<double*>(into);
  for (int k = 0; k < *count; ++k, a += 3, b += 3) {
    const double second = std::max(std::min(a[0], b[0]), std::max(a[1], b[1]));
    b[0] = std::max(a[0], b[0]);
    b[1] = second;
    b[2] = std::max(a[2], b[2]);
  }
}

}  // namespace

struct WatchReduction {
  MPI_Datatype type = MPI_DATATYPE_NULL;
  MPI_Op operation = MPI_OP_NULL;
  WatchReduction() {
    require_mpi(MPI_Type_contiguous(3, MPI_DOUBLE, &type), "MPI_Type_contiguous");
    require_mpi(MPI_Type_commit(&type), "MPI_Type_commit");
    require_mpi(MPI_Op_create(join_watches, 1, &operation), "MPI_Op_create");
  }
  ~WatchReduction() {
    MPI_Op_free(&operation);
    MPI_Type_free(&type);
  }
  WatchReduction(const WatchReduction&) = delete;
  WatchReduction& operator=(const WatchReduction&) = delete;
};

namespace {

double reach_of_lists(const BlockSettings& s) {
  return (cutoff_of(s.contact) + s.skin) / micrometre;
}

}  // namespace

template <class Real>
RegionRun<Real>::RegionRun(const BlockSettings& settings, const std::vector<CellKind>& kinds,
                           const RegionOptions& options, double start, const RankMessages& messages)
    : settings_(settings),
      kinds_(kinds),
      options_(options),
      messages_(messages),
      stepper_(settings),
      halo_({options.motion, settings.flow.get(), start, settings.time_step,
             options.exchange_interval},
            reach_of_lists(settings), messages) {
  if (messages_.size() == 1) return;
  reduction_ = std::make_unique<WatchReduction>();
  CopyUpdates updates;
  updates.interval = options.exchange_interval;
  updates.find = [this](std::int64_t step) { find_copies(step); };
  updates.sent_blocks = &halo_.sent_blocks();
  updates.send = [this](std::int64_t step) { halo_.send(store_, step); };
  updates.receive = [this](std::int64_t step, bool must_wait) {
    return halo_.receive(store_, step, must_wait);
  };
  updates.carry = [this](std::int64_t step, std::size_t group) {
    halo_.carry(store_, step, group);
  };
  updates.join = [this](const SharedWatch& own) { return join(own); };
  stepper_.keep_copies(std::move(updates));
}

template <class Real>
RegionRun<Real>::~RegionRun() = default;

template <class Real>
Periodicity RegionRun<Real>::periodicity(double image_offset) const {
  return {settings_.length / micrometre, settings_.periodic_y ? settings_.height / micrometre : 0,
          image_offset / micrometre};
}

/// The image of a frame inside the domain. [um]
template <class Real>
Vector<2> RegionRun<Real>::home_position(const Vector<2>& frame, double image_offset) const {
  const Periodicity p = periodicity(image_offset);
  Vector<2> home = frame;
  if (p.height > 0) {
    const double row = -std::floor(home.y() / p.height);
    home += Vector<2>(row * p.image_offset, row * p.height);
  }
  if (p.length > 0) home.x() -= p.length * std::floor(home.x() / p.length);
  return home;
}

template <class Real>
void RegionRun<Real>::deal(const std::vector<CellRecord>& cells, std::int64_t step,
                           double image_offset) {
  const auto begin = Clock::now();
  std::vector<CellPlace> places;
  Vector<2> lower = Vector<2>::Constant(std::numeric_limits<double>::max());
  Vector<2> upper = -lower;
  for (const CellRecord& cell : cells) {
    const Vector<2> home = home_position(cell.frame, image_offset);
    places.push_back({home, kinds_[static_cast<std::size_t>(cell.kind)].nodes});
    lower = lower.cwiseMin(home);
    upper = upper.cwiseMax(home);
  }
  const Periodicity p = periodicity(image_offset);
  lower = {messages_.smallest(lower.x()), messages_.smallest(lower.y())};
  upper = {messages_.largest(upper.x()), messages_.largest(upper.y())};
  if (p.length > 0) {
    lower.x() = 0;
    upper.x() = p.length;
  }
  if (p.height > 0) {
    lower.y() = 0;
    upper.y() = p.height;
  }
  // The upper borders belong to the domain.
  upper += Vector<2>::Constant(1e-6);
  const auto [columns, rows] = choose_grid(messages_.size(), upper.x() - lower.x(),
                                           upper.y() - lower.y(), p.length > 0, p.height > 0);
  const RegionGrid grid = cut_regions(places, columns, rows, lower, upper, messages_);
  counters_.columns = columns;
  middle_ = grid.middle(messages_.rank(), lower, upper);

  std::vector<Message> outgoing(static_cast<std::size_t>(messages_.size()));
  for (std::size_t k = 0; k < outgoing.size(); ++k) outgoing[k].rank = static_cast<int>(k);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const auto owner = static_cast<std::size_t>(grid.owner(places[k].position));
    append_cell(outgoing[owner].bytes, cells[k]);
  }
  std::vector<CellRecord> own;
  for (const Message& message : messages_.exchange(std::move(outgoing))) {
    read_cells(message.bytes, own);
  }
  // With copies along the channel, so that few blocks see them.
  const bool along = messages_.size() > 1 || exceed_cache(settings_, own.size());
  std::sort(own.begin(), own.end(), [&](const CellRecord& a, const CellRecord& b) {
    return order_of_cell(a, home_position(a.frame, image_offset), along) <
           order_of_cell(b, home_position(b.frame, image_offset), along);
  });
  std::size_t all = 0;
  for (const CellKind& kind : kinds_) all += kind.cells;
  store_ = make_store<Real>(kinds_, own, all, has_memory(settings_.integrator),
                            static_cast<std::size_t>(step % 2));
  // A rank without cells cannot tell whether those of others have a memory.
  store_.memory_is_new = messages_.largest(!own.empty() && store_.memory_is_new ? 1 : 0) > 0;
  stepper_.invalidate();
  copies_when_dealt_ = -1;
  spread_when_dealt_ = 0;
  must_deal_ = false;
  ++counters_.migrations;
  counters_.migration_seconds += seconds_since(begin);
}

template <class Real>
void RegionRun<Real>::find_copies(std::int64_t step) {
  const double offset = image_offset_ + slide_ * static_cast<double>(step - first_step_);
  halo_.find(store_, step, periodicity(offset), middle_);
  const std::int64_t copies =
      messages_.sum({static_cast<std::int64_t>(count_copies(store_))}).front();
  if (copies_when_dealt_ < 0) copies_when_dealt_ = copies;
  must_deal_ =
      static_cast<double>(copies) > options_.copy_growth * static_cast<double>(copies_when_dealt_);
}

template <class Real>
SharedWatch RegionRun<Real>::join(const SharedWatch& own) {
  const auto begin = Clock::now();
  double values[3] = {own.longest_travel, own.second_travel, own.finite ? 0.0 : 1.0};
  messages_.reduce(values, 1, reduction_->type, reduction_->operation);
  counters_.agreement_seconds += seconds_since(begin);
  // With copies, lists are pruned when contacts are searched for and at no other time.
  return {values[0], values[1], values[0], values[1], values[2] == 0};
}

template <class Real>
StretchWatch RegionRun<Real>::advance(std::int64_t step, std::int64_t count, double start,
                                      double& image_offset) {
  slide_ = settings_.periodic_y ? settings_.time_step * settings_.height *
                                      settings_.flow->at({0, 0}, 0).gradient(0, 1)
                                : 0;
  // Shear carries the cells of a block apart. One rank with many of them deals them into blocks
  // anew; several do so when copies have become many.
  const bool looks = messages_.size() == 1 && exceed_cache(settings_, store_.places());
  StretchWatch all;
  for (std::int64_t left = count; left > 0 && all.finite;) {
    const std::int64_t part = looks ? std::min(left, steps_between_looks) : left;
    if (must_deal_) deal(cells(step), step, image_offset);
    first_step_ = step;
    image_offset_ = image_offset;
    const StretchWatch watch = stepper_.advance(store_, step, part, start, image_offset);
    if (watch.largest_stretch > all.largest_stretch ||
        watch.smallest_stretch < all.smallest_stretch || !watch.finite) {
      all.worst_cell = watch.worst_cell;
    }
    all.largest_stretch = std::max(all.largest_stretch, watch.largest_stretch);
    all.smallest_stretch = std::min(all.smallest_stretch, watch.smallest_stretch);
    all.finite = watch.finite;
    step += part;
    left -= part;
    if (!looks) continue;
    if (spread_when_dealt_ == 0) spread_when_dealt_ = stepper_.spread();
    must_deal_ = stepper_.spread() > 2 * spread_when_dealt_;
  }
  return all;
}

template <class Real>
std::vector<CellRecord> RegionRun<Real>::cells(std::int64_t step) const {
  std::vector<CellRecord> result;
  for (std::size_t place = 0; place < store_.places(); ++place) {
    if (store_.ids[place] == no_cell) continue;
    result.push_back(read_cell(store_, place, static_cast<std::size_t>(step % 2)));
  }
  return result;
}

template <class Real>
RegionCounters RegionRun<Real>::region_counters() const {
  RegionCounters c = counters_;
  const auto& timing = halo_.timing();
  c.step_seconds = stepper_.counters().step_seconds;
  c.waiting_seconds = timing.waiting;
  c.exchange_seconds = timing.packing;
  c.search_seconds = timing.searching;
  c.messages = timing.messages;
  c.bytes = timing.bytes;
  for (const CellId id : store_.ids) c.cells += id != no_cell ? 1 : 0;
  c.copies = static_cast<std::int64_t>(count_copies(store_));
  c.cells -= c.copies;
  return c;
}

template class RegionRun<float>;
template class RegionRun<double>;

}  // namespace hemoscale::micro::regions
