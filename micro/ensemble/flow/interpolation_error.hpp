#pragma once

#include <cstddef>

#include "micro/ensemble/flow/grid_samples.hpp"
#include "micro/ensemble/flow/wall_geometry.hpp"

namespace hemoscale::micro {

/// How far a GridFlow is from the flow that its samples were taken from, by Richardson's
/// extrapolation: the flow made from every second node is compared with the samples left out. The
/// observed order p follows from the same with every fourth and every second node; then
///
///   error(h) = error(2 h) / 2^min(p, 2).
///
/// No more than the second order is counted on, although the method has more: samples of a solver
/// carry jumps of that order between its cells. Other errors of the samples are not seen.
struct InterpolationError {
  double rms = 0;             // [m/s] estimate for the grid
  double largest = 0;         // [m/s] estimate for the grid
  double coarse_rms = 0;      // [m/s] measured with every second node
  double coarse_largest = 0;  // [m/s] the same
  /// [-] observed; 0: none could be observed (too few samples, or the error does not fall), and the
  /// estimate is the one measured.
  double order_of_rms = 0;
  double order_of_largest = 0;
  std::size_t points = 0;  // samples that were left out
};

/// @throws ParameterError if fewer than four columns or rows are left of every second
InterpolationError interpolation_error(const GridSamples& samples,
                                       const WallGeometry* walls = nullptr);

}  // namespace hemoscale::micro
