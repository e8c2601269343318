#include "micro/ensemble/blocks/block_parts.hpp"

namespace hemoscale::micro::blocks {

template <class Real>
void BlockStepper<Real>::Parts::size_arrays(const BlockStore<Real>& store) {
  const std::size_t blocks = store.blocks.size();
  flow.assign(blocks * flow_rows * width, 0);
  frame_y.assign(blocks * width, 0);
  drift.assign(blocks * 2 * width, 0);
  extremes.assign(blocks * 3 * width, 0);
  velocity.assign(store.ids.size(), Vector<2>::Zero());
  migration.assign(store.places(), 0);
  travel.assign(store.places(), 0);
  travel_at_pruning.assign(store.places(), 0);
  longest.assign(store.places(), 1);
  shortest.assign(store.places(), 1);
  broken.assign(store.places(), 0);
  std::size_t most = 0;
  for (const CellKind& kind : store.kinds) {
    most = std::max(most, static_cast<std::size_t>(kind.nodes));
  }
  for (Scratch& s : scratch) {
    s.forces.assign(5 * most * width, 0);
    s.solver.assign(static_cast<std::size_t>(implicit_scratch_rows) * most * width, 0);
  }
  must_size = false;
}

/// Blocks [first, last) of a member of the team, in order.
template <class Real>
std::pair<std::size_t, std::size_t> BlockStepper<Real>::Parts::blocks_of(std::size_t blocks,
                                                                         std::size_t member) const {
  const auto threads = static_cast<std::size_t>(settings.threads);
  return {blocks * member / threads, blocks * (member + 1) / threads};
}

template <class Real>
void BlockStepper<Real>::Parts::order_blocks(const BlockStore<Real>& store) {
  const std::size_t blocks = store.blocks.size();
  awaited.assign(blocks, {});
  member_of_block.resize(blocks);
  std::vector<unsigned char> is_awaited(blocks, 0);
  std::vector<unsigned char> is_at_copies(blocks, 0);
  for (const ContactList& list : wide_lists) {
    const std::size_t first = list.first_block;
    const std::size_t last = first + list.first_active.size() - 1;
    for (std::size_t b = first; b < last; ++b) {
      for (std::size_t k = list.first_neighbour[(b - first) * width];
           k < list.first_neighbour[(b + 1 - first) * width]; ++k) {
        const auto other = static_cast<std::size_t>(list.neighbours[k].place) / width;
        if (other >= blocks) {
          awaited[b].push_back(other);
          is_at_copies[b] = 1;
        } else if (!copies && other != b) {
          awaited[b].push_back(other);
          if (other < first || other >= last) is_awaited[other] = 1;
        } else if (other < first || other >= last) {
          awaited[b].push_back(other);
          is_awaited[other] = 1;
        }
      }
      std::sort(awaited[b].begin(), awaited[b].end());
      awaited[b].erase(std::unique(awaited[b].begin(), awaited[b].end()), awaited[b].end());
    }
  }
  if (copies) {
    for (const std::size_t b : *copies->sent_blocks) is_at_copies[b] = 1;
  }
  spread = 0;
  for (std::size_t b = 0; b < blocks && !copies; ++b) {
    for (const std::size_t other : awaited[b]) {
      const std::size_t apart = std::max(b, other) - std::min(b, other);
      spread = std::max(spread, std::min(apart, blocks - apart));
    }
  }
  // Blocks that other threads wait for come first, those that wait for other ranks last.
  for (std::size_t member = 0; member < blocks_of_thread.size(); ++member) {
    const auto [first, last] = blocks_of(blocks, member);
    std::fill(member_of_block.begin() + static_cast<std::ptrdiff_t>(first),
              member_of_block.begin() + static_cast<std::ptrdiff_t>(last), member);
    blocks_of_thread[member].clear();
    for (const int turn : {0, 1, 2}) {
      for (std::size_t b = first; b < last; ++b) {
        const int own_turn = is_at_copies[b] != 0 ? 2 : is_awaited[b] != 0 ? 0 : 1;
        if (own_turn == turn) blocks_of_thread[member].push_back(b);
      }
    }
  }
  blocks_at_copies.clear();
  for (std::size_t b = 0; b < blocks; ++b) {
    if (is_at_copies[b] != 0) blocks_at_copies.push_back(b);
  }
  const std::size_t groups = count_copy_groups(store);
  groups_of_thread.assign(blocks_of_thread.size(), {});
  for (std::size_t g = 0; g < groups; ++g)
    groups_of_thread[g % groups_of_thread.size()].push_back(g);
  if (done.size() != blocks + groups) done = std::vector<Milestone>(blocks + groups);
}

template <class Real>
void BlockStepper<Real>::Parts::build_list(const BlockStore<Real>& store, std::int64_t step,
                                           double image_offset) {
  if (copies) {
    copies->find(step);
    found_at = step;
  }
  const auto begin = Clock::now();
  ContactSearch<Real> search(store, static_cast<std::size_t>(step % 2), periodicity(image_offset),
                             wide_range());
  const auto threads = static_cast<std::size_t>(settings.threads);
  team.run([&](int member) {
    const auto m = static_cast<std::size_t>(member);
    search.measure(store.ids.size() * m / threads, store.ids.size() * (m + 1) / threads);
  });
  search.sort();
  team.run([&](int member) {
    const auto m = static_cast<std::size_t>(member);
    const auto [first, last] = blocks_of(store.blocks.size(), m);
    wide_lists[m] = search.find(first, last);
    lists[m].first_block = wide_lists[m].first_block;
    lists[m].first_neighbour = wide_lists[m].first_neighbour;
    lists[m].neighbours = wide_lists[m].neighbours;
  });
  list_is_valid = true;
  strain = 0;
  std::fill(travel.begin(), travel.end(), 0.0);
  order_blocks(store);
  ++counters.rebuilds;
  counters.list_seconds += seconds_since(begin);
  prune_lists(store, step, image_offset);
}

/// With copies of cells of other ranks lists are pruned when contacts are searched for and at no
/// other time, because copies are not known well enough between exchanges: one range for both. [um]
template <class Real>
double BlockStepper<Real>::Parts::wide_range() const {
  return contact_cutoff + (copies ? share_with_copies : 1) * settings.skin / micrometre;
}

/// Lists are searched for with the whole skin and pruned, far oftener, to a part of it: the search
/// looks at boxes of clusters, pruning at the nodes. [um]
template <class Real>
double BlockStepper<Real>::Parts::inner_range() const {
  return copies ? wide_range() : contact_cutoff + inner_share * settings.skin / micrometre;
}

/// Displacements of the frames of all neighbours of a block from those of its cells.
template <class Real>
void BlockStepper<Real>::Parts::set_shifts(const BlockStore<Real>& store, std::int64_t step,
                                           const Periodicity& p, std::size_t block,
                                           const ContactList& list,
                                           std::vector<Real>& shifts) const {
  const std::size_t b = block - list.first_block;
  const std::size_t first_neighbour = list.first_neighbour[b * width];
  const std::vector<Vector<2>>& frames = store.frames[static_cast<std::size_t>(step % 2)];
  shifts.resize(2 * (list.first_neighbour[(b + 1) * width] - first_neighbour));
  for (std::size_t lane = 0; lane < width; ++lane) {
    for (std::size_t k = list.first_neighbour[b * width + lane];
         k < list.first_neighbour[b * width + lane + 1]; ++k) {
      const Vector<2> shift = shift_of(frames, block * width + lane, list.neighbours[k], p);
      shifts[2 * (k - first_neighbour)] = static_cast<Real>(shift.x());
      shifts[2 * (k - first_neighbour) + 1] = static_cast<Real>(shift.y());
    }
  }
}

template <class Real>
void BlockStepper<Real>::Parts::prune_block(const BlockStore<Real>& store, std::int64_t step,
                                            const Periodicity& p, std::size_t block,
                                            std::size_t member) {
  const ContactList& wide = wide_lists[member];
  ContactList& list = lists[member];
  const std::size_t b = block - wide.first_block;
  std::vector<Real>& shifts = scratch[member].shifts;
  set_shifts(store, step, p, block, wide, shifts);
  PruneArguments<Real> g;
  g.mirror = store.mirror[static_cast<std::size_t>(step % 2)].data();
  g.active = wide.active.data() + wide.first_active[b];
  g.active_count = static_cast<std::uint32_t>(wide.first_active[b + 1] - wide.first_active[b]);
  g.entries = wide.entries.data() + wide.first_entry[b];
  g.shifts = shifts.data();
  g.first_cluster = store.first_cluster.data() + block * width;
  const double reach = inner_range() + rounding_of_distances;
  g.reach_squared = static_cast<Real>(reach * reach);
  g.kept_active = list.active.data() + list.first_active.back();
  g.kept_entries = list.entries.data() + list.first_entry.back();
  const PruneCounts kept = table.prune(g);
  list.first_active.push_back(list.first_active.back() + kept.active);
  list.first_entry.push_back(list.first_entry.back() + kept.entries);
}

template <class Real>
void BlockStepper<Real>::Parts::prune_lists(const BlockStore<Real>& store, std::int64_t step,
                                            double image_offset) {
  const auto begin = Clock::now();
  team.run([&](int number) {
    const auto member = static_cast<std::size_t>(number);
    const ContactList& wide = wide_lists[member];
    ContactList& list = lists[member];
    // One more of each, because an entry is written before it is known whether it stays.
    list.active.resize(wide.active.size() + 1);
    list.entries.resize(wide.entries.size() + 1);
    list.first_active.assign(1, 0);
    list.first_entry.assign(1, 0);
    const auto [first, last] = blocks_of(store.blocks.size(), member);
    const Periodicity p = periodicity(image_offset);
    for (std::size_t block = first; block < last; ++block) {
      prune_block(store, step, p, block, member);
    }
  });
  must_prune = false;
  strain_at_pruning = strain;
  travel_at_pruning = travel;
  reach_before = inner_reach({});
  counters.list_seconds += seconds_since(begin);
}

namespace {

/// The two longest of travels [um].
void add_travel(double travel, double& longest, double& second) {
  if (travel > longest) {
    second = longest;
    longest = travel;
  } else {
    second = std::max(second, travel);
  }
}

}  // namespace

template <class Real>
SharedWatch BlockStepper<Real>::Parts::watch_cells(const BlockStore<Real>& store) const {
  SharedWatch watch;
  for (std::size_t place = 0; place < store.places(); ++place) {
    add_travel(travel[place], watch.longest_travel, watch.second_travel);
    add_travel(travel[place] - travel_at_pruning[place], watch.longest_since_pruning,
               watch.second_since_pruning);
    if (broken[place] != 0) watch.finite = false;
  }
  return copies ? copies->join(watch) : watch;
}

/// Two nodes that are now nearer than rc were nearer than exp(strain) (rc + both travels) when the
/// list was pruned, by Gronwall's inequality run backwards; travel counts against the flow at the
/// node, for frames of cells in contact are carried apart by more than the nodes. [um]
template <class Real>
double BlockStepper<Real>::Parts::inner_reach(const SharedWatch& watch) const {
  return std::exp(strain - strain_at_pruning) *
         (contact_cutoff + rounding_of_distances + watch.longest_since_pruning +
          watch.second_since_pruning);
}

/// The same for nodes that are now nearer than the inner range, since the search. [um]
template <class Real>
double BlockStepper<Real>::Parts::wide_reach(const SharedWatch& watch) const {
  return std::exp(strain) *
         (inner_range() + 2 * rounding_of_distances + watch.longest_travel + watch.second_travel);
}

template struct BlockStepper<float>::Parts;
template struct BlockStepper<double>::Parts;

}  // namespace hemoscale::micro::blocks
