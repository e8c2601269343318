#pragma once

#include <vector>

#include "micro/immersed/cell.hpp"
#include "micro/model.hpp"

namespace hemoscale::micro {

/// Adds positions and velocities of all nodes to a snapshot, under names that begin with "cells.".
void store_cells(const std::vector<Cell>& cells, Snapshot& snapshot);

/// Puts stored positions and velocities into the same cells.
/// @throws ParameterError if the snapshot holds other cells
void load_cells(const Snapshot& snapshot, std::vector<Cell>& cells);

/// The values stored under a name.
/// @throws ParameterError naming it unless there are `size`
const std::vector<double>& stored_reals(const Snapshot& snapshot, const char* name,
                                        std::size_t size);
const std::vector<std::int64_t>& stored_integers(const Snapshot& snapshot, const char* name,
                                                 std::size_t size);

}  // namespace hemoscale::micro
