#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "micro/ensemble/blocks/block_store.hpp"
#include "micro/model.hpp"

// What snapshots of an ensemble have in common, on one process or spread over ranks.
namespace hemoscale::micro::blocks {

/// Frames, areas, nodes and memory of the cells as the arrays "blocks.*" of a snapshot.
void set_arrays(Snapshot& snapshot, const std::vector<CellRecord>& cells);

/// An array of a snapshot.
/// @throws ParameterError unless it is there, of this size, and finite
const std::vector<double>& finite_reals(const Snapshot& snapshot, const std::string& name,
                                        std::size_t size);

}  // namespace hemoscale::micro::blocks
