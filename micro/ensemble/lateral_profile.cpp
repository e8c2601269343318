#include "micro/ensemble/lateral_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemoscale::micro {

double area_below(const double* x, const double* y, std::size_t nodes, double line) {
  double area = 0;
  const double origin = x[0];
  for (std::size_t i = 0; i < nodes; ++i) {
    const std::size_t j = i + 1 == nodes ? 0 : i + 1;
    const double low = std::min(y[i], line);
    const double high = std::min(y[j], line);
    if (low == high) {
      continue;
    }
    // Middle of the part of the segment below the line; x varies linearly along it.
    const double slope = (x[j] - x[i]) / (y[j] - y[i]);
    area += (x[i] - origin + slope * (0.5 * (low + high) - y[i])) * (high - low);
  }
  return area;
}

ProfileAverage::ProfileAverage(const Box& box, int bins)
    : box_(box),
      bins_(static_cast<std::size_t>(bins)),
      area_(bins_, 0.0),
      velocity_(bins_, 0.0),
      nodes_(bins_, 0) {}

void ProfileAverage::add_area(const EnsembleState& state) {
  const double width = box_.height / static_cast<double>(bins_);
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    const double* const x = state.x.data() + cell * state.nodes;
    const double* const y = state.y.data() + cell * state.nodes;
    double below = 0;  // area beyond the lower wall belongs to the first bin
    for (std::size_t b = 0; b < bins_; ++b) {
      const bool last = b + 1 == bins_;
      const double line =
          last ? std::numeric_limits<double>::max() : width * static_cast<double>(b + 1);
      const double next = area_below(x, y, state.nodes, line);
      area_[b] += next - below;
      below = next;
    }
  }
}

void ProfileAverage::add_free_layer(const EnsembleState& state) {
  // Columns of about 1 um, as an observer of a vessel would average; columns without a membrane do
  // not count.
  constexpr double column_width = 1e-6;  // [m]
  const auto columns =
      static_cast<std::size_t>(std::max(1.0, std::round(box_.length / column_width)));
  std::vector<double> lowest(columns, box_.height);
  std::vector<double> highest(columns, 0.0);
  const double per_length = static_cast<double>(columns) / box_.length;
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    for (std::size_t k = 0; k < state.nodes; ++k) {
      const std::size_t i = cell * state.nodes + k;
      const std::size_t j = cell * state.nodes + (k + 1) % state.nodes;
      const double from = std::min(state.x[i], state.x[j]) * per_length;
      const double to = std::max(state.x[i], state.x[j]) * per_length;
      const double low = std::min(state.y[i], state.y[j]);
      const double high = std::max(state.y[i], state.y[j]);
      for (double c = std::floor(from); c < to || c == std::floor(from); ++c) {
        const double turns = std::floor(c / static_cast<double>(columns));
        const auto column = static_cast<std::size_t>(c - turns * static_cast<double>(columns));
        lowest[column] = std::min(lowest[column], low);
        highest[column] = std::max(highest[column], high);
      }
    }
  }
  double sum = 0;
  std::size_t covered = 0;
  for (std::size_t c = 0; c < columns; ++c) {
    if (highest[c] >= lowest[c]) {
      sum += 0.5 * (lowest[c] + box_.height - highest[c]);
      ++covered;
    }
  }
  free_layer_ += covered > 0 ? sum / static_cast<double>(covered) : 0.5 * box_.height;
}

void ProfileAverage::add(const EnsembleState& state, const CubicProfile& flow,
                         const std::vector<double>& force_x, double node_drag, double wall_force) {
  for (std::size_t i = 0; i < state.x.size(); ++i) {
    const double place = state.y[i] / box_.height * static_cast<double>(bins_);
    const double last = static_cast<double>(bins_ - 1);
    const auto b = static_cast<std::size_t>(std::clamp(place, 0.0, last));
    velocity_[b] += flow(state.y[i]) + force_x[i] / node_drag;
    ++nodes_[b];
  }
  add_area(state);
  add_free_layer(state);
  wall_force_ += wall_force;
  ++samples_;
}

LateralProfile ProfileAverage::mean() const {
  const auto samples = static_cast<double>(samples_);
  const double width = box_.height / static_cast<double>(bins_);
  LateralProfile profile;
  for (std::size_t b = 0; b < bins_; ++b) {
    profile.y.push_back(width * (static_cast<double>(b) + 0.5));
    profile.area_fraction.push_back(area_[b] / (samples * width * box_.length));
    profile.cell_velocity.push_back(nodes_[b] > 0 ? velocity_[b] / static_cast<double>(nodes_[b])
                                                  : 0);
  }
  profile.cell_free_layer = free_layer_ / samples;
  profile.wall_pressure = wall_force_ / (2 * samples * box_.length);
  return profile;
}

}  // namespace hemoscale::micro
