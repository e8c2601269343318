#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "micro/ensemble/observables/cell_shape.hpp"
#include "micro/ensemble/observables/slices.hpp"
#include "micro/ensemble/state.hpp"

namespace hemoscale::micro {

/// Where the cells are across a channel with walls at y = 0 and y = H. Unless said otherwise a cell
/// counts by its centroid Y, and its distance is d = |2 Y/H - 1|: 0 on the axis, 1 at a wall.
struct LateralMoments {
  double mean_distance = 0;  // [-] <d>: 1/2 for a uniform distribution
  double second_moment = 0;  // [m^2] <(Y - H/2)^2>: H^2/12 for a uniform distribution
  double width = 0;  // [-] of the concentration: sqrt(int (y - H/2)^2 dA / A / (H^2/12)), by
                     // area; 1 if uniform, 0 if all cells were on the axis
  double core_fraction = 0;  // [-] share of the area within |y - H/2| < H/4: 1/2 if uniform
};

/// @param height  [m] of the channel
/// @pre at least one cell
LateralMoments lateral_moments(const EnsembleState& state, std::span<const CellShape> shapes,
                               double height);

/// Share of the cells in each of `bins` equal bins of the distance d, from the axis to the wall;
/// the shares sum to one.
/// @throws NumericalError with cell and place if a centroid lies outside the channel
std::vector<double> distance_histogram(const EnsembleState& state,
                                       std::span<const CellShape> shapes, double height,
                                       std::size_t bins);

/// Mean area fraction of the core |y - H/2| < H/4 [-], of a profile from wall to wall.
double core_value(std::span<const double> fractions);

/// Distance from a wall at which an area fraction, zero at the wall and linear between the middles
/// of the bins, first reaches half its core value [m]; mean of both walls. None without a core.
/// Half the height less this is the half-width of the concentration at half its core value.
std::optional<double> half_core_distance(std::span<const double> fractions, double height);

}  // namespace hemoscale::micro
