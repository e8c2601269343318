#include "micro/ensemble/blocks/block_stepper.hpp"

#include "micro/ensemble/blocks/block_parts.hpp"

namespace hemoscale::micro::blocks {

/// Finds the displacements of the step before the first, so that the prediction is as good from the
/// start as later: the iteration of a step, repeated while nothing moves.
template <class Real>
void BlockStepper<Real>::Parts::prepare(BlockStore<Real>& store, std::int64_t step, double time,
                                        double image_offset) {
  const Real usual = share;
  share = 1;
  move = 0;
  const std::int64_t iterations = predicts ? preparing_iterations : 2;
  for (std::int64_t k = 0; k < iterations; ++k) {
    if (copies && k > 0) {
      copies->send(step + k);
      copies->receive(step + k, true);
    }
    team.run([&](int member) {
      for (const std::size_t block : blocks_of_thread[static_cast<std::size_t>(member)]) {
        step_block(store, step + k, time, image_offset, block,
                   lists[static_cast<std::size_t>(member)],
                   scratch[static_cast<std::size_t>(member)]);
      }
    });
  }
  share = usual;
  move = 1;
  store.memory_is_new = false;
  std::fill(travel.begin(), travel.end(), 0.0);
  list_is_valid = false;
}

/// Advances all blocks of a thread, and the copies that it carries, from a step to the next. Member
/// 0 exchanges the copies: it sends when the cells in question are there, receives when blocks that
/// see copies come up, and looks after the messages in between.
template <class Real>
void BlockStepper<Real>::Parts::step_member(BlockStore<Real>& store, std::int64_t step,
                                            int member) {
  const std::size_t blocks = store.blocks.size();
  const auto number = static_cast<std::size_t>(member);
  const auto wait_at_copies = [&] {
    for (const std::size_t b : blocks_at_copies) done[b].wait_for(step);
  };
  bool is_pending = member == 0 && copies_are_due(step);
  const auto receive = [&](bool must_wait) {
    if (!copies->receive(step, must_wait)) return;
    for (std::size_t g = blocks; g < done.size(); ++g) done[g].set(step);
    is_pending = false;
  };
  if (is_pending) {
    wait_at_copies();
    copies->send(step);
  }
  for (const std::size_t block : blocks_of_thread[number]) {
    if (is_pending) {
      const bool sees_copies = !awaited[block].empty() && awaited[block].back() >= blocks;
      receive(sees_copies);
    }
    for (const std::size_t other : awaited[block]) done[other].wait_for(step);
    step_block(store, step, time_of(step), offset_of(step), block, lists[number], scratch[number]);
    done[block].set(step + 1);
  }
  if (is_pending) receive(true);
  if (!copies || copies->come_anew(step + 1)) return;
  for (const std::size_t group : groups_of_thread[number]) {
    done[blocks + group].wait_for(step);
    wait_at_copies();
    copies->carry(step, group);
    done[blocks + group].set(step + 1);
  }
}

/// What is read and written in a step.
template <class Real>
std::size_t BlockStepper<Real>::Parts::bytes_of(const BlockStore<Real>& store) const {
  std::size_t entries = 0;
  for (const ContactList& list : lists) entries += list.first_entry.back();
  return sizeof(Real) * (store.x.size() + store.y.size() + store.memory_x.size() +
                         store.memory_y.size() + store.mirror[0].size() + store.mirror[1].size()) +
         sizeof(ClusterEntry) * entries;
}

/// Who advances which block when, for a leg without copies.
template <class Real>
void BlockStepper<Real>::Parts::set_schedules(const BlockStore<Real>& store, std::size_t steps) {
  const std::size_t blocks = store.blocks.size();
  const std::size_t bytes = bytes_of(store);
  std::vector<ScheduleShape> shapes;
  std::size_t round = bytes > settings.cache ? steps : 0;
  for (std::size_t member = 0; member < schedules.size(); ++member) {
    const auto [first, last] = blocks_of(blocks, member);
    shapes.push_back(
        {first, last, blocks, spread,
         blocks * (settings.cache / tiles_in_cache) / std::max<std::size_t>(bytes, 1)});
    round = std::min(round, steps_of_round(shapes.back()));
  }
  if (round >= least_round) ++counters.tiled_legs;
  for (std::size_t member = 0; member < schedules.size(); ++member) {
    std::vector<BlockTask>& tasks = schedules[member];
    if (round >= least_round) {
      tasks = tiled_schedule(shapes[member], steps, round);
      continue;
    }
    tasks.clear();
    for (std::size_t step = 0; step < steps; ++step) {
      for (const std::size_t block : blocks_of_thread[member]) {
        tasks.push_back({static_cast<std::uint32_t>(block), static_cast<std::uint32_t>(step)});
      }
    }
  }
}

/// Advances from step `first` to `last`, without copies. A thread that is done with its own tasks
/// takes over what others have not begun: their data are not at hand, but nobody waits.
template <class Real>
void BlockStepper<Real>::Parts::share_leg(BlockStore<Real>& store, std::int64_t first,
                                          std::int64_t last) {
  set_schedules(store, static_cast<std::size_t>(last - first));
  for (Milestone& each : done) each.set(first);
  for (Turn& turn : turns) turn.next = 0;
  std::atomic<bool> failed{false};
  team.run([&](int number) {
    const auto member = static_cast<std::size_t>(number);
    try {
      for (std::size_t k = 0; k < turns.size(); ++k) {
        const std::size_t owner = (member + k) % turns.size();
        const std::vector<BlockTask>& tasks = schedules[owner];
        while (!failed) {
          const std::size_t turn = turns[owner].next.fetch_add(1);
          if (turn >= tasks.size()) break;
          const std::int64_t step = first + tasks[turn].step;
          const std::size_t block = tasks[turn].block;
          // Another thread may have taken the block before, and not be done with it.
          done[block].wait_for(step);
          for (const std::size_t other : awaited[block]) done[other].wait_for(step);
          step_block(store, step, time_of(step), offset_of(step), block,
                     lists[member_of_block[block]], scratch[member]);
          done[block].set(step + 1);
        }
      }
    } catch (...) {
      failed = true;
      for (Milestone& each : done) each.set(last);
      throw;
    }
  });
}

/// The same with copies of cells of other ranks: every thread has blocks of its own. A thread that
/// fails lets go of those that wait for it; the others end at their next step.
template <class Real>
void BlockStepper<Real>::Parts::run_leg(BlockStore<Real>& store, std::int64_t first,
                                        std::int64_t last) {
  const std::size_t blocks = store.blocks.size();
  const bool is_due = copies_are_due(first);
  for (std::size_t k = 0; k < done.size(); ++k) {
    done[k].set(k >= blocks && is_due ? first - 1 : first);
  }
  std::atomic<bool> failed{false};
  const auto let_go = [&](std::size_t member) {
    constexpr std::int64_t never_waited_for = std::numeric_limits<std::int64_t>::max();
    for (const std::size_t block : blocks_of_thread[member]) done[block].set(never_waited_for);
    for (const std::size_t group : groups_of_thread[member])
      done[blocks + group].set(never_waited_for);
    for (std::size_t g = blocks; g < done.size() && member == 0; ++g) done[g].set(never_waited_for);
  };
  team.run([&](int member) {
    try {
      for (std::int64_t s = first; s < last && !failed; ++s) {
        step_member(store, s, member);
      }
    } catch (...) {
      failed = true;
      let_go(static_cast<std::size_t>(member));
      throw;
    }
    if (failed) let_go(static_cast<std::size_t>(member));
  });
}

template <class Real>
BlockStepper<Real>::BlockStepper(BlockSettings settings)
    : parts_(std::make_unique<Parts>(std::move(settings))) {}
template <class Real>
BlockStepper<Real>::~BlockStepper() = default;
template <class Real>
BlockStepper<Real>::BlockStepper(BlockStepper&&) noexcept = default;

template <class Real>
void BlockStepper<Real>::invalidate() {
  parts_->list_is_valid = false;
  parts_->must_size = true;
}
template <class Real>
void BlockStepper<Real>::keep_copies(CopyUpdates updates) {
  parts_->copies = std::move(updates);
  invalidate();
}
template <class Real>
const StepCounters& BlockStepper<Real>::counters() const {
  return parts_->counters;
}
template <class Real>
std::size_t BlockStepper<Real>::spread() const {
  return parts_->spread;
}
template <class Real>
const BlockSettings& BlockStepper<Real>::settings() const {
  return parts_->settings;
}
template <class Real>
const std::vector<ContactList>& BlockStepper<Real>::contacts() const {
  return parts_->lists;
}

template <class Real>
StretchWatch BlockStepper<Real>::advance(BlockStore<Real>& store, std::int64_t step,
                                         std::int64_t count, double start, double& image_offset) {
  Parts& p = *parts_;
  const BlockSettings& settings = p.settings;
  const double dt = settings.time_step;
  const double rate = settings.flow->largest_shear_rate();
  if (p.must_size) p.size_arrays(store);
  bool must_set_flow = true;
  std::fill(p.longest.begin(), p.longest.end(), 1.0);
  std::fill(p.shortest.begin(), p.shortest.end(), 1.0);
  p.first_step = step;
  p.start = start;
  p.offsets = {image_offset};
  p.slide =
      settings.periodic_y ? dt * settings.height * settings.flow->at({0, 0}, 0).gradient(0, 1) : 0;
  const std::int64_t last = step + count;
  const std::int64_t interval = p.copies ? p.copies->interval : 1;
  StretchWatch watch;
  while (step < last && watch.finite) {
    const bool must_centre = step % steps_between_centrings == 0;
    if (must_centre || must_set_flow) {
      p.team.run([&](int member) {
        const auto [first, end] =
            p.blocks_of(store.blocks.size(), static_cast<std::size_t>(member));
        for (std::size_t b = first; b < end; ++b) {
          if (must_centre) p.centre_block(store, step, b);
          p.set_flow(store, step, p.time_of(step), b);
          if (p.keeps_motion() && store.memory_is_new) p.expect_drift(store, b);
          p.write_mirror(store, static_cast<std::size_t>(step % 2), b);
        }
      });
      must_set_flow = false;
    }
    if (!p.list_is_valid) p.build_list(store, step, p.offset_of(step));
    if (p.keeps_motion() && store.memory_is_new) {
      p.prepare(store, step, p.time_of(step), p.offset_of(step));
      p.build_list(store, step, p.offset_of(step));
    }
    if (p.must_prune) p.prune_lists(store, step, p.offset_of(step));
    store.memory_is_new = false;
    // As many steps as the list will surely last, judged by the steps so far; but lists are built
    // only where copies come anew.
    const std::int64_t to_centring = steps_between_centrings - step % steps_between_centrings;
    std::int64_t leg =
        std::min({last - step, to_centring, longest_leg, longest_growth * p.leg_before});
    const double range = p.inner_range();
    const double used_before = p.reach_before;
    const double left = (range - used_before) / (caution * p.reach_per_step);
    if (left < static_cast<double>(leg)) {
      const std::int64_t end = step + static_cast<std::int64_t>(left);
      const std::int64_t next = (step / interval + 1) * interval;
      leg = std::min(leg, std::max(end - end % interval, next) - step);
    }
    const auto begin = Clock::now();
    p.set_offsets(step, step + leg);
    if (p.copies) {
      p.run_leg(store, step, step + leg);
    } else {
      p.share_leg(store, step, step + leg);
    }
    p.counters.step_seconds += seconds_since(begin);
    step += leg;
    p.strain += rate * dt * static_cast<double>(leg);
    const SharedWatch seen = p.watch_cells(store);
    const double used = p.inner_reach(seen);
    p.reach_before = used;
    p.reach_per_step = std::max({(used - used_before) / static_cast<double>(leg),
                                 memory_of_motion * p.reach_per_step, least_reach_per_step});
    p.leg_before = leg;
    if (used > range) ++p.counters.late_rebuilds;
    const double ahead = caution * p.reach_per_step * static_cast<double>(interval);
    if (step % interval == 0 && used + ahead > range) {
      p.must_prune = !p.copies && p.wide_reach(seen) < p.wide_range();
      p.list_is_valid = p.must_prune;
    }
    watch.finite = seen.finite;
  }
  image_offset = p.offset_of(step);
  for (std::size_t place = 0; place < store.places() && !watch.finite; ++place) {
    if (p.broken[place] != 0) {
      watch.worst_cell = store.ids[place];
      break;
    }
  }
  double worst = 0;
  for (std::size_t place = 0; place < store.places(); ++place) {
    const double strain = std::max(p.longest[place], 1 / p.shortest[place]) - 1;
    if (watch.finite && !(strain <= worst)) {
      worst = strain;
      watch.worst_cell = store.ids[place];
    }
    watch.largest_stretch = std::max(watch.largest_stretch, p.longest[place]);
    watch.smallest_stretch = std::min(watch.smallest_stretch, p.shortest[place]);
  }
  return watch;
}

template class BlockStepper<float>;
template class BlockStepper<double>;

}  // namespace hemoscale::micro::blocks
