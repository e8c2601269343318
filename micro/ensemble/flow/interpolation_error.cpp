#include "micro/ensemble/flow/interpolation_error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "micro/ensemble/flow/grid_flow.hpp"

namespace hemoscale::micro {
namespace {

constexpr double counted_order = 2;
constexpr std::size_t fewest_points = 32;  // for an observed order

struct Comparison {
  double rms = 0;      // [m/s]
  double largest = 0;  // [m/s]
  std::size_t points = 0;
};

/// The flow from every second node against the samples that it does not know.
Comparison compared_with_half(const GridSamples& samples, const WallGeometry* walls) {
  const GridFlow flow(coarsened(samples), walls);
  Comparison result;
  double sum = 0;
  for (std::size_t row = 0; row < samples.rows; ++row) {
    for (std::size_t column = 0; column < samples.columns; ++column) {
      const std::optional<Vector<2>>& exact = samples.velocities[samples.index(column, row)];
      if (!exact || (row % 2 == 0 && column % 2 == 0)) continue;
      const double error = (flow.at(samples.place(column, row), 0).velocity - *exact).norm();
      sum += error * error;
      result.largest = std::max(result.largest, error);
      ++result.points;
    }
  }
  if (result.points > 0) result.rms = std::sqrt(sum / static_cast<double>(result.points));
  return result;
}

double observed_order(double coarse, double fine) {
  if (!(coarse > fine) || !(fine > 0)) return 0;
  return std::log2(coarse / fine);
}

}  // namespace

InterpolationError interpolation_error(const GridSamples& samples, const WallGeometry* walls) {
  const Comparison fine = compared_with_half(samples, walls);
  InterpolationError error;
  error.coarse_rms = fine.rms;
  error.coarse_largest = fine.largest;
  error.points = fine.points;
  const GridSamples half = coarsened(samples);
  if (half.columns >= 8 && half.rows >= 8) {
    const Comparison coarse = compared_with_half(half, walls);
    if (coarse.points >= fewest_points) {
      error.order_of_rms = observed_order(coarse.rms, fine.rms);
      error.order_of_largest = observed_order(coarse.largest, fine.largest);
    }
  }
  error.rms = fine.rms / std::exp2(std::min(error.order_of_rms, counted_order));
  error.largest = fine.largest / std::exp2(std::min(error.order_of_largest, counted_order));
  return error;
}

}  // namespace hemoscale::micro
