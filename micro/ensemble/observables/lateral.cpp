#include "micro/ensemble/observables/lateral.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "micro/error.hpp"

namespace hemoscale::micro {

LateralMoments lateral_moments(const EnsembleState& state, std::span<const CellShape> shapes,
                               double height) {
  const double axis = 0.5 * height;
  LateralMoments moments;
  double area = 0;
  double area_moment = 0;
  const LateralBins quarters{.height = height, .count = 4};
  std::array<Slice, 4> slices;
  for (std::size_t cell = 0; cell < shapes.size(); ++cell) {
    const CellShape& shape = shapes[cell];
    const double off = shape.centre.y() - axis;
    moments.mean_distance += std::abs(off) / axis;
    moments.second_moment += off * off;
    area += shape.area;
    area_moment += shape.area * (off * off + shape.gyration(1, 1));
    add_slices(state, cell, shape.centre, quarters, slices);
  }
  const auto cells = static_cast<double>(shapes.size());
  moments.mean_distance /= cells;
  moments.second_moment /= cells;
  moments.width = std::sqrt(area_moment / area * 12) / height;
  moments.core_fraction = (slices[1].area + slices[2].area) / area;
  return moments;
}

std::vector<double> distance_histogram(const EnsembleState& state,
                                       std::span<const CellShape> shapes, double height,
                                       std::size_t bins) {
  std::vector<double> shares(bins, 0.0);
  for (std::size_t cell = 0; cell < shapes.size(); ++cell) {
    const double y = shapes[cell].centre.y();
    const double distance = std::abs(2 * y / height - 1);
    if (!(distance < 1)) {
      throw NumericalError(fmt::format(
          "step {}, time {:.6g} s: the centre of cell {} is at y = {:.6g} m; the channel reaches "
          "from 0 to {:.6g} m; stiffen the walls or reduce the time step",
          state.step, state.time, cell, y, height));
    }
    shares[static_cast<std::size_t>(distance * static_cast<double>(bins))] +=
        1 / static_cast<double>(shapes.size());
  }
  return shares;
}

double core_value(std::span<const double> fractions) {
  // Bins that the border of the core cuts count by their share.
  const auto count = static_cast<double>(fractions.size());
  double sum = 0;
  for (std::size_t b = 0; b < fractions.size(); ++b) {
    const double low = std::max(static_cast<double>(b) / count, 0.25);
    const double high = std::min(static_cast<double>(b + 1) / count, 0.75);
    sum += fractions[b] * std::max(high - low, 0.0);
  }
  return sum / 0.5;
}

std::optional<double> half_core_distance(std::span<const double> fractions, double height) {
  const double half = 0.5 * core_value(fractions);
  if (!(half > 0)) return std::nullopt;
  const std::size_t count = fractions.size();
  const double width = height / static_cast<double>(count);
  double sum = 0;
  for (const bool upper : {false, true}) {
    double place = 0;  // [m] from the wall
    double value = 0;
    for (std::size_t b = 0; b < count; ++b) {
      const double next_place = width * (static_cast<double>(b) + 0.5);
      const double next = fractions[upper ? count - 1 - b : b];
      if (next >= half) {
        sum += place + (half - value) / (next - value) * (next_place - place);
        break;
      }
      place = next_place;
      value = next;
    }
  }
  return sum / 2;
}

}  // namespace hemoscale::micro
