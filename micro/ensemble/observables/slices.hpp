#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "micro/ensemble/state.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Bins of equal height from the wall at y = 0 to the wall at y = height.
struct LateralBins {
  double height = 0;      // [m] of the channel
  std::size_t count = 0;  // [-]

  double width() const { return height / static_cast<double>(count); }  // [m]
  double middle(std::size_t bin) const {
    return width() * (static_cast<double>(bin) + 0.5);
  }  // [m]

  /// The bin of a height; what lies beyond a wall belongs to the bin at that wall.
  std::size_t bin_of(double y) const;
};

/// Part of a cell in one bin.
struct Slice {
  double area = 0;                       // [m^2]
  Vector<2> moment = Vector<2>::Zero();  // [m^3] int (r - origin) dA
};

/// Adds the parts of one cell, a polygon counter-clockwise, to slices.
///
/// Exact: with Green's theorem the area of a part is the integral of x dy along the piece of the
/// outline that lies in the bin; the cuts are horizontal and add nothing. Area beyond a wall
/// belongs to the bin at that wall, so that the slices sum to the cell.
/// @param slices  one for each bin
void add_slices(const EnsembleState& state, std::size_t cell, const Vector<2>& origin,
                const LateralBins& bins, std::span<Slice> slices);

/// Area fraction of the cells in each bin [-]: their area in the bin over that of the bin.
/// @param length  of the channel [m]
std::vector<double> area_fractions(const EnsembleState& state, double length,
                                   const LateralBins& bins);

}  // namespace hemoscale::micro
