#pragma once

#include <cstddef>
#include <cstring>

#include "micro/ensemble/blocks/block_store.hpp"

namespace hemoscale::micro::regions {

/// Where the mirror of a cell begins in that of its store.
template <class Real>
std::size_t mirror_begin(const blocks::BlockStore<Real>& store, std::size_t place) {
  return 8 * static_cast<std::size_t>(store.first_cluster[place]);
}

/// Numbers of the mirror of a cell.
template <class Real>
std::size_t mirror_size(const blocks::BlockStore<Real>& store, std::size_t place) {
  return 8 * store.clusters_of_kind(static_cast<std::size_t>(store.kind_of_place[place]));
}

/// Bytes of a copy in a message: its frame and its mirror.
template <class Real>
std::size_t copy_bytes(const blocks::BlockStore<Real>& store, std::size_t place) {
  return 2 * sizeof(double) + mirror_size(store, place) * sizeof(Real);
}

template <class T>
char* write(char* at, const T* values, std::size_t count) {
  std::memcpy(at, values, count * sizeof(T));
  return at + count * sizeof(T);
}
template <class T>
const char* read(const char* at, T* values, std::size_t count) {
  std::memcpy(values, at, count * sizeof(T));
  return at + count * sizeof(T);
}

}  // namespace hemoscale::micro::regions
