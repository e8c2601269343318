#pragma once

#include <cstdint>
#include <vector>

#include "micro/ensemble/blocks/block_store.hpp"
#include "micro/model.hpp"

namespace hemoscale::micro::regions {

/// When a snapshot was taken.
struct SnapshotClock {
  std::int64_t step = 0;
  double start = 0;         // [s] time of step 0
  double image_offset = 0;  // [m]
};

/// Cells in the order of their numbers, as named arrays: the format of BlockEnsemble.
Snapshot to_snapshot(const std::vector<blocks::CellRecord>& cells, const SnapshotClock& clock);

/// @param kinds  all cells of the ensemble
/// @throws ParameterError if the snapshot is not one of such an ensemble
std::vector<blocks::CellRecord> from_snapshot(const Snapshot& snapshot,
                                              const std::vector<blocks::CellKind>& kinds,
                                              SnapshotClock& clock);

}  // namespace hemoscale::micro::regions
