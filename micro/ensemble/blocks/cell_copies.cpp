#include "micro/ensemble/blocks/cell_copies.hpp"

namespace hemoscale::micro::blocks {

template <class Real>
void set_copies(BlockStore<Real>& store, const std::vector<CopiedCell>& cells) {
  const std::size_t own = store.places();
  store.ids.resize(own);
  store.kind_of_place.resize(own);
  store.first_cluster.resize(own);
  std::size_t clusters = 0;
  if (own > 0) {
    clusters = store.first_cluster.back() +
               store.clusters_of_kind(static_cast<std::size_t>(store.kind_of_place.back()));
  }
  for (const CopiedCell& cell : cells) {
    store.ids.push_back(cell.id);
    store.kind_of_place.push_back(cell.kind);
    store.first_cluster.push_back(static_cast<std::uint32_t>(clusters));
    clusters += store.clusters_of_kind(static_cast<std::size_t>(cell.kind));
  }
  for (std::size_t parity = 0; parity < 2; ++parity) {
    store.mirror[parity].resize(8 * clusters);
    store.frames[parity].resize(store.ids.size(), Vector<2>::Zero());
  }
}

template void set_copies<float>(BlockStore<float>&, const std::vector<CopiedCell>&);
template void set_copies<double>(BlockStore<double>&, const std::vector<CopiedCell>&);

}  // namespace hemoscale::micro::blocks
