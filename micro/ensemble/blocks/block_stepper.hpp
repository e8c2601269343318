#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "micro/ensemble/blocks/block_settings.hpp"
#include "micro/ensemble/blocks/block_store.hpp"
#include "micro/ensemble/blocks/contact_list.hpp"
#include "micro/ensemble/blocks/copy_updates.hpp"
#include "micro/ensemble/blocks/kernel_arguments.hpp"
#include "micro/parallel/thread_team.hpp"

namespace hemoscale::micro::blocks {

/// What is known of the cells after a stretch of steps.
struct StretchWatch {
  double largest_stretch = 1;   // [-] l / l0 of any segment at any step
  double smallest_stretch = 1;  // [-]
  CellId worst_cell = no_cell;  // that has one of the two
  bool finite = true;
};

/// Counters of the work, for timings and tests.
struct StepCounters {
  std::int64_t rebuilds = 0;
  std::int64_t late_rebuilds = 0;  // a node may have moved further than the skin before one
  std::int64_t tiled_legs = 0;     // stretches of steps that were taken in tiles
  double list_seconds = 0;
  double step_seconds = 0;
};

/// Advances the cells of a store. Owns lists and scratch memory; state is in the store alone.
///
/// Blocks are dealt to threads in order; before a step a thread waits only for the blocks that are
/// in contact with its own and belong to others, and it begins with those that others wait for. No
/// number depends on the number of threads: every cell is advanced by the same operations.
template <class Real>
class BlockStepper {
 public:
  explicit BlockStepper(BlockSettings settings);
  ~BlockStepper();
  BlockStepper(BlockStepper&&) noexcept;

  /// Positions of the store were changed by others: forget the list.
  void invalidate();

  /// The store has, or may get, copies of cells of other ranks, which are kept up to date like
  /// this.
  void keep_copies(CopyUpdates updates);

  /// Advances from step `step` by `count` steps; buffer step % 2 holds the state before.
  /// @param start         [s] time of step 0
  /// @param image_offset  [m] of the image above at the step; advanced with the flow
  StretchWatch advance(BlockStore<Real>& store, std::int64_t step, std::int64_t count, double start,
                       double& image_offset);

  const StepCounters& counters() const;
  const BlockSettings& settings() const;
  /// How far apart, by number, blocks lie that see each other's cells. [-]
  std::size_t spread() const;
  /// The lists in use, one per thread.
  const std::vector<ContactList>& contacts() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace hemoscale::micro::blocks
