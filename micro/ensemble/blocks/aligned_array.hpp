#pragma once

#include <cstddef>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace hemoscale::micro::blocks {

/// Allocator of memory that vector instructions may load from directly. Large arrays ask for large
/// pages where the system grants them: ensembles that exceed the cache spend a tenth of their time
/// on looking up small ones.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::size_t large_page = 2U << 20U;

  AlignedAllocator() = default;
  template <class U>
  explicit AlignedAllocator(const AlignedAllocator<U>&) {}

  static std::align_val_t alignment(std::size_t n) {
    return std::align_val_t{n * sizeof(T) >= 2 * large_page ? large_page : 64};
  }
  T* allocate(std::size_t n) {
    void* const memory = ::operator new(n * sizeof(T), alignment(n));
#if defined(__linux__)
    // Advice; without it everything works the same.
    if (n * sizeof(T) >= 2 * large_page) madvise(memory, n * sizeof(T), MADV_HUGEPAGE);
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* p, std::size_t n) {
    ::operator delete(p, alignment(n));
  }
  bool operator==(const AlignedAllocator&) const {
    return true;
  }
};

template <class T>
using AlignedArray = std::vector<T, AlignedAllocator<T>>;

}  // namespace hemoscale::micro::blocks
