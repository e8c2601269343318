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
  std::vector<unsigned char> is_awaited(blocks, 0);
  std::vector<unsigned char> is_at_copies(blocks, 0);
  for (const ContactList& list : lists) {
    const std::size_t first = list.first_block;
    const std::size_t last = first + list.first_active.size() - 1;
    for (std::size_t b = first; b < last; ++b) {
      for (std::size_t k = list.first_neighbour[(b - first) * width];
           k < list.first_neighbour[(b + 1 - first) * width]; ++k) {
        const auto other = static_cast<std::size_t>(list.neighbours[k].place) / width;
        if (other >= blocks) {
          awaited[b].push_back(other);
          is_at_copies[b] = 1;
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
  // Blocks that other threads wait for come first, those that wait for other ranks last.
  for (std::size_t member = 0; member < blocks_of_thread.size(); ++member) {
    const auto [first, last] = blocks_of(blocks, member);
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
  const double range = contact_cutoff + settings.skin / micrometre;
  ContactSearch<Real> search(store, static_cast<std::size_t>(step % 2), periodicity(image_offset),
                             range);
  const auto threads = static_cast<std::size_t>(settings.threads);
  team.run([&](int member) {
    const auto m = static_cast<std::size_t>(member);
    search.measure(store.ids.size() * m / threads, store.ids.size() * (m + 1) / threads);
  });
  search.sort();
  team.run([&](int member) {
    const auto m = static_cast<std::size_t>(member);
    const auto [first, last] = blocks_of(store.blocks.size(), m);
    lists[m] = search.find(first, last);
  });
  list_is_valid = true;
  strain = 0;
  std::fill(travel.begin(), travel.end(), 0.0);
  reach_before = reach({});
  order_blocks(store);
  ++counters.rebuilds;
  counters.list_seconds += seconds_since(begin);
}

template <class Real>
SharedWatch BlockStepper<Real>::Parts::watch_cells(const BlockStore<Real>& store) const {
  SharedWatch watch;
  for (const double t : travel) {
    if (t > watch.longest_travel) {
      watch.second_travel = watch.longest_travel;
      watch.longest_travel = t;
    } else {
      watch.second_travel = std::max(watch.second_travel, t);
    }
  }
  for (std::size_t place = 0; place < store.places(); ++place) {
    if (broken[place] != 0) watch.finite = false;
  }
  return copies ? copies->join(watch) : watch;
}

/// Two nodes that are now nearer than rc were nearer than exp(strain) (rc + both travels) when the
/// list was built, by Gronwall's inequality run backwards; travel counts against the flow at the
/// node, for frames of cells in contact are carried apart by more than the nodes. [um]
template <class Real>
double BlockStepper<Real>::Parts::reach(const SharedWatch& watch) const {
  return std::exp(strain) *
         (contact_cutoff + rounding_of_distances + watch.longest_travel + watch.second_travel);
}

template struct BlockStepper<float>::Parts;
template struct BlockStepper<double>::Parts;

}  // namespace hemoscale::micro::blocks
