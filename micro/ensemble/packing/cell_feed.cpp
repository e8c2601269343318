#include "micro/ensemble/packing/cell_feed.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "micro/cells/outline_checks.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

// Motion between two looks over the overhang.
constexpr double share_of_overhang = 1.0 / 16;

// Places are tried so far to either side of the one that was drawn, in radii of the cell: farther
// away the profile across the inlet would change.
constexpr double reach_along = 2;

double radius_of(std::span<const Vector<2>> outline) {
  double radius = 0;
  for (const Vector<2>& node : outline) radius = std::max(radius, node.norm());
  return radius;
}

[[noreturn]] void refuse(const std::string& text) {
  throw ParameterError("feed of cells: " + text);
}

void require_fit(const FeedPlan& plan, const blocks::BlockSettings& settings) {
  if (settings.length > 0 || plan.room.length > 0) {
    refuse(
        fmt::format("the channel repeats itself every {} m; cells enter and leave only where it "
                    "is open; leave out the period, or the feed",
                    std::max(settings.length, plan.room.length)));
  }
  if (!(plan.overhang > 0) || !std::isfinite(plan.overhang)) {
    refuse(
        fmt::format("the channel is continued by {} m beyond its openings; it must be finite and "
                    "positive; choose about twice the length of a cell",
                    plan.overhang));
  }
  const double speed = settings.flow->largest_speed();
  if (speed * settings.time_step > share_of_overhang * plan.overhang) {
    refuse(fmt::format(
        "cells move by up to {:.3g} m in a step of {:.3g} s at {:.3g} m/s; at most a "
        "sixteenth of the overhang of {:.3g} m is admitted; reduce the step or lengthen "
        "the overhang",
        speed * settings.time_step, settings.time_step, speed, plan.overhang));
  }
  for (const Opening& outlet : plan.outlets) check(outlet);
  for (const FedKind& fed : plan.inlets) {
    check(fed.inlet);
    if (fed.kind >= settings.kinds.size() ||
        fed.outline.size() != static_cast<std::size_t>(settings.kinds[fed.kind].mesh.nodes)) {
      refuse(
          fmt::format("cells of kind {} with {} nodes are to enter at {}; the ensemble has {} "
                      "kinds, and their meshes decide the number of nodes; correct them",
                      fed.kind, fed.outline.size(), fed.inlet.name, settings.kinds.size()));
    }
    if (radius_of(fed.outline) > plan.overhang) {
      refuse(
          fmt::format("cells of radius {:.3g} m enter at {}, where the channel is continued by "
                      "{:.3g} m; lengthen the overhang",
                      radius_of(fed.outline), fed.inlet.name, plan.overhang));
    }
  }
}

}  // namespace

CellFeed::CellFeed(FeedPlan plan, const blocks::BlockSettings& settings, std::uint64_t seed,
                   std::uint64_t stream)
    : plan_(std::move(plan)), time_step_(settings.time_step) {
  require_fit(plan_, settings);
  for (std::size_t k = 0; k < plan_.inlets.size(); ++k) {
    const FedKind& fed = plan_.inlets[k];
    const std::uint64_t own_stream = stream + (static_cast<std::uint64_t>(k) << 32U);
    inlets_.push_back({fed,
                       enclosed_area(fed.outline),
                       radius_of(fed.outline),
                       InflowQueue(fed.inlet, fed.feed, settings.flow, seed, own_stream),
                       {}});
  }
  counts_.resize(settings.kinds.size());
  for (FeedCounts& c : counts_) c.left.assign(plan_.outlets.size(), 0);
  const double step = settings.flow->largest_speed() * time_step_;
  constexpr double longest = 1000;  // steps, where hardly anything flows
  interval_ = static_cast<std::int64_t>(
      std::min(longest, step > 0 ? share_of_overhang * plan_.overhang / step : longest));
}

void CellFeed::advance(BlockEnsemble& ensemble, std::int64_t steps) {
  while (steps > 0) {
    const std::int64_t to_look = interval_ - ensemble.step() % interval_;
    const std::int64_t leg = std::min(steps, to_look);
    ensemble.advance(leg);
    steps -= leg;
    if (ensemble.step() % interval_ == 0) {
      look(ensemble, ensemble.time() - static_cast<double>(interval_) * time_step_);
    }
  }
}

void CellFeed::look(BlockEnsemble& ensemble, double since) {
  const std::vector<blocks::CellId> gone = leaving(ensemble);
  std::vector<EnsembleState> entering(counts_.size());
  for (std::size_t k = 0; k < entering.size(); ++k) {
    entering[k].nodes = static_cast<std::size_t>(ensemble.settings().kinds[k].mesh.nodes);
  }
  bool has_entered = false;
  for (Inlet& inlet : inlets_) {
    inlet.queue.advance(since, static_cast<double>(interval_) * time_step_);
    while (inlet.queue.due(inlet.cell_area) > 0) {
      inlet.waiting.push_back(inlet.queue.take(inlet.cell_area, ensemble.time()));
      ++counts_[inlet.fed.kind].waiting;
    }
    if (inlet.waiting.empty()) continue;
    const std::size_t before = entering[inlet.fed.kind].cells;
    admit(inlet, ensemble, entering);
    has_entered = has_entered || entering[inlet.fed.kind].cells > before;
    if (inlet.waiting.size() > plan_.largest_backlog) {
      throw NumericalError(fmt::format(
          "step {}, time {:.6g} s: {} cells wait for a free place at {}, and at most {} may; a "
          "hematocrit of {} does not enter at random places; lower it or the clearance of {:.3g} "
          "m, "
          "or lengthen the overhang of {:.3g} m",
          ensemble.step(), ensemble.time(), inlet.waiting.size(), inlet.fed.inlet.name,
          plan_.largest_backlog, inlet.fed.feed.hematocrit, plan_.clearance.cells, plan_.overhang));
    }
  }
  if (has_entered || !gone.empty()) ensemble.exchange(gone, entering);
}

std::vector<blocks::CellId> CellFeed::leaving(const BlockEnsemble& ensemble) {
  const auto frames = ensemble.frames();
  const auto ids = ensemble.identities();
  std::vector<blocks::CellId> gone;
  for (std::size_t kind = 0; kind < frames.size(); ++kind) {
    for (std::size_t k = 0; k < frames[kind].size(); ++k) {
      const auto outlet = std::find_if(
          plan_.outlets.begin(), plan_.outlets.end(),
          [&](const Opening& o) { return has_left(o, frames[kind][k], plan_.overhang); });
      if (outlet == plan_.outlets.end()) continue;
      gone.push_back(ids[kind][k]);
      ++counts_[kind].left[static_cast<std::size_t>(outlet - plan_.outlets.begin())];
    }
  }
  return gone;
}

void CellFeed::admit(Inlet& inlet, const BlockEnsemble& ensemble,
                     std::vector<EnsembleState>& entering) {
  const auto frames = ensemble.frames();
  const auto ids = ensemble.identities();
  double largest = 2 * inlet.radius;
  for (const Inlet& other : inlets_) largest = std::max(largest, 2 * other.radius);
  Occupancy occupancy(plan_.room, plan_.clearance, largest);
  // Stretched cells may be longer than those that enter.
  const double deepest = inlet.radius + plan_.clearance.cells + 2 * largest;
  for (std::size_t kind = 0; kind < frames.size(); ++kind) {
    for (std::size_t k = 0; k < frames[kind].size(); ++k) {
      if (depth(inlet.fed.inlet, frames[kind][k]) > deepest) continue;
      occupancy.add(ensemble.nodes_of(ids[kind][k]));
    }
    occupancy.add(entering[kind]);
  }
  std::vector<Arrival> still_waiting;
  for (const Arrival& arrival : inlet.waiting) {
    Search search;
    search.place = arrival.place;
    search.angle = arrival.angle;
    search.along = inlet.fed.inlet.tangent();
    search.reach_along = reach_along * inlet.radius;
    search.back = -inlet.fed.inlet.inward();
    search.reach_back = plan_.overhang - inlet.radius;
    const auto ring = free_place(occupancy, inlet.fed.outline, search);
    if (!ring) {
      still_waiting.push_back(arrival);
      continue;
    }
    occupancy.add(*ring);
    append_cell(*ring, entering[inlet.fed.kind]);
    ++counts_[inlet.fed.kind].entered;
    --counts_[inlet.fed.kind].waiting;
  }
  inlet.waiting = std::move(still_waiting);
}

Snapshot CellFeed::snapshot() const {
  Snapshot s;
  auto& queue = s.reals["feed.queue"];
  auto& arrivals = s.integers["feed.arrivals"];
  auto& waiting = s.integers["feed.waiting"];
  auto& places = s.reals["feed.places"];
  auto& counts = s.integers["feed.counts"];
  for (const Inlet& inlet : inlets_) {
    queue.push_back(inlet.queue.state().area);
    arrivals.push_back(static_cast<std::int64_t>(inlet.queue.state().arrivals));
    waiting.push_back(std::ssize(inlet.waiting));
    for (const Arrival& a : inlet.waiting) {
      places.insert(places.end(), {a.place.x(), a.place.y(), a.angle});
    }
  }
  for (const FeedCounts& c : counts_) {
    counts.push_back(static_cast<std::int64_t>(c.entered));
    for (const std::uint64_t n : c.left) counts.push_back(static_cast<std::int64_t>(n));
  }
  return s;
}

void CellFeed::restore(const Snapshot& snapshot) {
  const auto integers = [&](const char* name) {
    const auto found = snapshot.integers.find(name);
    return found == snapshot.integers.end() ? std::vector<std::int64_t>() : found->second;
  };
  const auto reals = [&](const char* name) {
    const auto found = snapshot.reals.find(name);
    return found == snapshot.reals.end() ? std::vector<double>() : found->second;
  };
  const auto queue = reals("feed.queue");
  const auto places = reals("feed.places");
  const auto arrivals = integers("feed.arrivals");
  const auto waiting = integers("feed.waiting");
  const auto counts = integers("feed.counts");
  const auto is_count = [](std::int64_t n) { return n >= 0; };
  std::size_t all_waiting = 0;
  const bool are_counts = std::all_of(arrivals.begin(), arrivals.end(), is_count) &&
                          std::all_of(waiting.begin(), waiting.end(), is_count) &&
                          std::all_of(counts.begin(), counts.end(), is_count);
  for (const std::int64_t n : waiting) all_waiting += are_counts ? static_cast<std::size_t>(n) : 0;
  if (!are_counts || queue.size() != inlets_.size() || arrivals.size() != inlets_.size() ||
      waiting.size() != inlets_.size() || places.size() != 3 * all_waiting ||
      counts.size() != counts_.size() * (1 + plan_.outlets.size())) {
    throw ParameterError(
        "snapshot: it holds no state of a feed with these inlets, outlets and kinds; restore it "
        "into "
        "a feed with the same plan");
  }
  std::size_t next = 0;
  for (FeedCounts& c : counts_) {
    c.entered = static_cast<std::uint64_t>(counts[next++]);
    c.waiting = 0;
    for (std::uint64_t& n : c.left) n = static_cast<std::uint64_t>(counts[next++]);
  }
  std::size_t place = 0;
  for (std::size_t k = 0; k < inlets_.size(); ++k) {
    Inlet& inlet = inlets_[k];
    inlet.queue.restore({queue[k], static_cast<std::uint64_t>(arrivals[k])});
    inlet.waiting.clear();
    for (std::int64_t n = 0; n < waiting[k]; ++n, place += 3) {
      inlet.waiting.push_back({{places[place], places[place + 1]}, places[place + 2]});
    }
    counts_[inlet.fed.kind].waiting += inlet.waiting.size();
  }
}

}  // namespace hemoscale::micro
