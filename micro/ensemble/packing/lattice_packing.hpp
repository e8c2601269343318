#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>

#include "micro/ensemble/box.hpp"
#include "micro/ensemble/state.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Sites of a lattice across and along the channel.
struct LatticeShape {
  std::size_t rows = 0;     // one above the other, along y
  std::size_t columns = 0;  // one behind the other, along x
};

struct LatticeOptions {
  std::size_t cells = 0;
  std::optional<LatticeShape> shape =
      std::nullopt;                          // empty: gaps along x and y as equal as possible
  double orientation = 0;                    // [rad] of the long axis; 0: along the flow
  double tilt = 2 * std::numbers::pi / 180;  // [rad] largest, to either side of it
  double gap = 0;       // [m] at least between the rectangles that hold the cells at any tilt
  double wall_gap = 0;  // [m] of the outermost cells from the walls, beside half the gap
};

struct LatticePacking {
  EnsembleState state;
  LatticeShape shape;
  double gap_along = 0;   // [m] between the rectangles that hold the cells, along x
  double gap_across = 0;  // [m] the same along y
};

/// Cells in rows and columns with random tilts, the same for the same seed and stream. Sites are
/// filled column after column; the last ones stay empty if there are more than cells.
///
/// A perfect lattice slides past itself without ever touching: rows need the tilts to meet.
///
/// @param outline  undeformed cell, centred on the origin, long axis along x [m]
/// @throws ParameterError for what does not fit: area fraction, gap needed and left, how many cells
///         would fit, remedies
LatticePacking pack_on_lattice(std::span<const Vector<2>> outline, const Box& box,
                               const LatticeOptions& options, std::uint64_t seed,
                               std::uint64_t stream);

}  // namespace hemoscale::micro
