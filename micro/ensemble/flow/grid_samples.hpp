#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Velocities at the nodes of a square grid; a node outside the fluid has none.
struct GridSamples {
  Vector<2> origin = Vector<2>::Zero();  // [m] the node of the first column and row
  double spacing = 0;                    // [m]
  std::size_t columns = 0;               // along x
  std::size_t rows = 0;                  // along y
  std::vector<std::optional<Vector<2>>> velocities = {};  // [m/s] row after row

  std::size_t index(std::size_t column, std::size_t row) const { return row * columns + column; }

  Vector<2> place(std::size_t column, std::size_t row) const {
    return origin + spacing * Vector<2>(static_cast<double>(column), static_cast<double>(row));
  }
};

/// Every second column and row, from the first.
GridSamples coarsened(const GridSamples& samples);

/// @throws ParameterError for a spacing that is not positive, fewer than four columns or rows,
/// lists
///         of another length, velocities that are not finite, no node in the fluid
void check(const GridSamples& samples);

}  // namespace hemoscale::micro
