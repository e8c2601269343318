#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace hemoscale::micro::blocks {

/// What the ranks must know of each other's cells to decide together how long lists last.
struct SharedWatch {
  double longest_travel = 0;  // [um] of any cell relative to the flow since contacts were searched
  double second_travel = 0;   // [um] of another cell
  double longest_since_pruning = 0;  // [um] the same since lists were pruned
  double second_since_pruning = 0;   // [um]
  bool finite = true;
};

/// How the copies of cells of other ranks follow their owners while the blocks advance. Copies come
/// anew at steps that are multiples of `interval`, the only ones at which lists are built; in
/// between they are carried. All but `carry` are called by the thread that advances the store, on
/// every rank at the same steps.
struct CopyUpdates {
  std::int64_t interval = 1;  // [steps]
  /// Finds out which cells need copies, and fills them with the positions at a step.
  std::function<void(std::int64_t step)> find;
  /// Blocks that hold cells with copies elsewhere, since the last `find`.
  const std::vector<std::size_t>* sent_blocks = nullptr;
  /// Sends own positions at a step; begins to receive those of others.
  std::function<void(std::int64_t step)> send;
  /// Whether all copies hold the positions at a step; if `must_wait`, not before they do.
  std::function<bool(std::int64_t step, bool must_wait)> receive;
  /// Carries a group of copies from a step to the next. Called from any thread.
  std::function<void(std::int64_t step, std::size_t group)> carry;
  /// Joins what the ranks saw; the same result on all.
  std::function<SharedWatch(const SharedWatch&)> join;

  bool come_anew(std::int64_t step) const { return step % interval == 0; }
};

}  // namespace hemoscale::micro::blocks
