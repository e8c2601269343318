#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "micro/ensemble/blocks/block_store.hpp"
#include "micro/ensemble/blocks/contact_list.hpp"
#include "micro/ensemble/regions/copy_carrier.hpp"
#include "micro/ensemble/regions/rank_messages.hpp"

namespace hemoscale::micro::regions {

/// Copies of the cells of other ranks that may come into contact with own ones, and their exchange.
/// Who has copies of whom is found from boxes around cells, wherever the regions are: a cell that
/// has strayed from the region of its rank is found as well.
template <class Real>
class Halo {
 public:
  struct Timing {
    double waiting = 0;    // [s] for messages, with nothing else to do
    double packing = 0;    // [s] forming and reading messages
    double searching = 0;  // [s] who needs copies of whom
    std::int64_t messages = 0;
    std::int64_t bytes = 0;
  };

  /// @param range  [um] between boxes: contact cutoff and skin
  Halo(const CopyCarrierSettings& settings, double range, const RankMessages& messages);

  /// Finds the copies that this rank needs, and gets their positions at a step. Collective.
  /// @param middle  [um] of the own region: its cells are looked for near it, not across the period
  void find(blocks::BlockStore<Real>& store, std::int64_t step,
            const blocks::Periodicity& periodicity, const Vector<2>& middle);

  void send(const blocks::BlockStore<Real>& store, std::int64_t step);
  bool receive(blocks::BlockStore<Real>& store, std::int64_t step, bool must_wait);
  void carry(blocks::BlockStore<Real>& store, std::int64_t step, std::size_t group) const {
    carrier_.carry(store, step, group);
  }

  const std::vector<std::size_t>& sent_blocks() const { return sent_blocks_; }
  const Timing& timing() const { return timing_; }

 private:
  static constexpr std::size_t width = blocks::BlockStore<Real>::width;

  /// Another rank with which copies are exchanged.
  struct Peer {
    int rank = 0;
    std::vector<std::size_t> sent;      // own places
    std::vector<std::size_t> received;  // places of the copies
    std::vector<char> outgoing, incoming;
  };

  void pack(const blocks::BlockStore<Real>& store, std::int64_t step, Peer& peer) const;

  double range_;  // [um]
  const RankMessages& messages_;
  CopyCarrier<Real> carrier_;
  std::vector<Peer> peers_;
  std::vector<MPI_Request> requests_;
  std::vector<std::size_t> sent_blocks_;
  Timing timing_;
};

}  // namespace hemoscale::micro::regions
