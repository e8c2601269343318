#include "micro/ensemble/flow/grid_samples.hpp"

#include <fmt/core.h>

#include <cmath>

#include "micro/error.hpp"

namespace hemoscale::micro {

GridSamples coarsened(const GridSamples& samples) {
  GridSamples coarse;
  coarse.origin = samples.origin;
  coarse.spacing = 2 * samples.spacing;
  coarse.columns = (samples.columns + 1) / 2;
  coarse.rows = (samples.rows + 1) / 2;
  coarse.velocities.reserve(coarse.columns * coarse.rows);
  for (std::size_t row = 0; row < coarse.rows; ++row) {
    for (std::size_t column = 0; column < coarse.columns; ++column) {
      coarse.velocities.push_back(samples.velocities[samples.index(2 * column, 2 * row)]);
    }
  }
  return coarse;
}

void check(const GridSamples& samples) {
  if (!(samples.spacing > 0) || !std::isfinite(samples.spacing) || !samples.origin.allFinite()) {
    throw ParameterError(
        fmt::format("flow on a grid: spacing {} m, origin ({}, {}) m; the spacing must be positive "
                    "and all finite; correct them",
                    samples.spacing, samples.origin[0], samples.origin[1]));
  }
  if (samples.columns < 4 || samples.rows < 4 ||
      samples.velocities.size() != samples.columns * samples.rows) {
    throw ParameterError(
        fmt::format("flow on a grid: {} columns, {} rows, {} velocities; there must be at least "
                    "four of each and a velocity (or none) for every node; use a finer grid",
                    samples.columns, samples.rows, samples.velocities.size()));
  }
  std::size_t known = 0;
  for (std::size_t k = 0; k < samples.velocities.size(); ++k) {
    if (!samples.velocities[k]) continue;
    ++known;
    if (samples.velocities[k]->allFinite()) continue;
    const Vector<2> x = samples.place(k % samples.columns, k / samples.columns);
    throw ParameterError(
        fmt::format("flow on a grid: the velocity at ({}, {}) m is not finite; check the flow that "
                    "it was taken from",
                    x[0], x[1]));
  }
  if (known == 0) {
    throw ParameterError(
        "flow on a grid: no node lies in the fluid; move the grid over it or refine it");
  }
}

}  // namespace hemoscale::micro
