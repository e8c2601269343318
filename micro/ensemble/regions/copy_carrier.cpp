#include "micro/ensemble/regions/copy_carrier.hpp"

#include <algorithm>

#include "micro/ensemble/regions/copy_bytes.hpp"

namespace hemoscale::micro::regions {

using blocks::BlockStore;
using blocks::micrometre;

namespace {

template <class Real>
std::size_t nodes_of(const BlockStore<Real>& store, std::size_t place) {
  return static_cast<std::size_t>(
      store.kinds[static_cast<std::size_t>(store.kind_of_place[place])].nodes);
}

}  // namespace

template <class Real>
const char* CopyCarrier<Real>::place_copy(BlockStore<Real>& store, std::int64_t step,
                                          std::size_t place, const char* bytes) {
  const auto now = static_cast<std::size_t>(step % 2);
  Vector<2>& frame = store.frames[now][place];
  bytes = read(bytes, frame.data(), 2);
  bytes =
      read(bytes, store.mirror[now].data() + mirror_begin(store, place), mirror_size(store, place));
  set_motion(motions_[place - store.places()], frame, step);
  return bytes;
}

template <class Real>
void CopyCarrier<Real>::set_motion(Motion& motion, const Vector<2>& frame,
                                   std::int64_t step) const {
  if (settings_.motion == CopyMotion::frozen || settings_.interval == 1) return;
  const double dt = settings_.time_step;
  const LocalFlow local =
      settings_.flow->at(frame * micrometre, settings_.start + static_cast<double>(step) * dt);
  motion.frame = local.velocity * (dt / micrometre);
  for (std::size_t k = 0; k < 2; ++k) {
    Real* const row = k == 0 ? motion.x : motion.y;
    const auto i = static_cast<Eigen::Index>(k);
    row[0] = static_cast<Real>(dt * local.gradient(i, 0));
    row[1] = static_cast<Real>(dt * local.gradient(i, 1));
    row[2] = static_cast<Real>(0.5 * dt * micrometre * local.second[k](0, 0));
    row[3] = static_cast<Real>(dt * micrometre * local.second[k](0, 1));
    row[4] = static_cast<Real>(0.5 * dt * micrometre * local.second[k](1, 1));
  }
}

template <class Real>
void CopyCarrier<Real>::carry(BlockStore<Real>& store, std::int64_t step, std::size_t group) const {
  constexpr std::size_t width = BlockStore<Real>::width;
  const std::size_t first = store.places() + group * width;
  const std::size_t last = std::min(store.ids.size(), first + width);
  for (std::size_t place = first; place < last; ++place) carry_copy(store, step, place);
}

template <class Real>
void CopyCarrier<Real>::carry_copy(BlockStore<Real>& store, std::int64_t step,
                                   std::size_t place) const {
  const auto now = static_cast<std::size_t>(step % 2);
  const std::size_t next = 1 - now;
  const Motion& m = motions_[place - store.places()];
  const Real* const from = store.mirror[now].data() + mirror_begin(store, place);
  Real* const to = store.mirror[next].data() + mirror_begin(store, place);
  store.frames[next][place] = store.frames[now][place] + m.frame;
  const std::size_t n = nodes_of(store, place);
  for (std::size_t first = 0; first < n; first += 4) {
    // Nodes that the last cluster lacks stay far away.
    const std::size_t count = std::min<std::size_t>(4, n - first);
    for (std::size_t i = 2 * first; i < 2 * first + count; ++i) {
      const Real x = from[i];
      const Real y = from[i + 4];
      to[i] = x + (x * (m.x[0] + m.x[2] * x + m.x[3] * y) + y * (m.x[1] + m.x[4] * y));
      to[i + 4] = y + (x * (m.y[0] + m.y[2] * x + m.y[3] * y) + y * (m.y[1] + m.y[4] * y));
    }
  }
}

template class CopyCarrier<float>;
template class CopyCarrier<double>;

}  // namespace hemoscale::micro::regions
