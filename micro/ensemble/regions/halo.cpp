#include "micro/ensemble/regions/halo.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "micro/ensemble/blocks/cell_copies.hpp"
#include "micro/ensemble/regions/copy_bytes.hpp"
#include "micro/ensemble/regions/halo_search.hpp"

namespace hemoscale::micro::regions {

using blocks::BlockStore;

namespace {

constexpr int tag_of_copies = 2;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

}  // namespace

template <class Real>
Halo<Real>::Halo(const CopyCarrierSettings& settings, double range, const RankMessages& messages)
    : range_(range), messages_(messages), carrier_(settings) {}

template <class Real>
void Halo<Real>::find(BlockStore<Real>& store, std::int64_t step,
                      const blocks::Periodicity& periodicity, const Vector<2>& middle) {
  const auto begin = Clock::now();
  std::vector<Neighbourhood> found = find_neighbourhoods(store, static_cast<std::size_t>(step % 2),
                                                         periodicity, range_, middle, messages_);
  peers_.clear();
  sent_blocks_.clear();
  std::vector<blocks::CopiedCell> copies;
  for (Neighbourhood& n : found) {
    Peer peer;
    peer.rank = n.rank;
    peer.sent = std::move(n.sent);
    for (const std::size_t place : peer.sent) sent_blocks_.push_back(place / width);
    for (std::size_t k = 0; k < n.received.size(); ++k) {
      peer.received.push_back(store.places() + copies.size());
      copies.push_back({n.received[k], n.received_kinds[k]});
    }
    peers_.push_back(std::move(peer));
  }
  std::sort(sent_blocks_.begin(), sent_blocks_.end());
  sent_blocks_.erase(std::unique(sent_blocks_.begin(), sent_blocks_.end()), sent_blocks_.end());
  blocks::set_copies(store, copies);
  for (Peer& peer : peers_) {
    std::size_t out = 0;
    std::size_t in = 0;
    for (const std::size_t place : peer.sent) out += copy_bytes(store, place);
    for (const std::size_t place : peer.received) in += copy_bytes(store, place);
    peer.outgoing.resize(out);
    peer.incoming.resize(in);
  }
  carrier_.begin(store);
  timing_.searching += seconds_since(begin);
  send(store, step);
  receive(store, step, true);
}

template <class Real>
void Halo<Real>::pack(const BlockStore<Real>& store, std::int64_t step, Peer& peer) const {
  const auto now = static_cast<std::size_t>(step % 2);
  char* at = peer.outgoing.data();
  for (const std::size_t place : peer.sent) {
    at = write(at, store.frames[now][place].data(), 2);
    at =
        write(at, store.mirror[now].data() + mirror_begin(store, place), mirror_size(store, place));
  }
}

template <class Real>
void Halo<Real>::send(const BlockStore<Real>& store, std::int64_t step) {
  const auto begin = Clock::now();
  requests_.assign(2 * peers_.size(), MPI_REQUEST_NULL);
  for (std::size_t k = 0; k < peers_.size(); ++k) {
    Peer& peer = peers_[k];
    require_mpi(MPI_Irecv(peer.incoming.data(), static_cast<int>(peer.incoming.size()), MPI_BYTE,
                          peer.rank, tag_of_copies, messages_.native(), &requests_[2 * k]),
                "MPI_Irecv");
  }
  for (std::size_t k = 0; k < peers_.size(); ++k) {
    Peer& peer = peers_[k];
    pack(store, step, peer);
    require_mpi(MPI_Isend(peer.outgoing.data(), static_cast<int>(peer.outgoing.size()), MPI_BYTE,
                          peer.rank, tag_of_copies, messages_.native(), &requests_[2 * k + 1]),
                "MPI_Isend");
    timing_.bytes += static_cast<std::int64_t>(peer.outgoing.size());
  }
  timing_.messages += static_cast<std::int64_t>(peers_.size());
  timing_.packing += seconds_since(begin);
}

template <class Real>
bool Halo<Real>::receive(BlockStore<Real>& store, std::int64_t step, bool must_wait) {
  if (must_wait) {
    timing_.waiting += messages_.wait(requests_);
  } else {
    int done = 0;
    require_mpi(MPI_Testall(static_cast<int>(requests_.size()), requests_.data(), &done,
                            MPI_STATUSES_IGNORE),
                "MPI_Testall");
    if (done == 0) return false;
  }
  const auto begin = Clock::now();
  for (const Peer& peer : peers_) {
    const char* at = peer.incoming.data();
    for (const std::size_t place : peer.received) at = carrier_.place_copy(store, step, place, at);
  }
  timing_.packing += seconds_since(begin);
  return true;
}

template class Halo<float>;
template class Halo<double>;

}  // namespace hemoscale::micro::regions
