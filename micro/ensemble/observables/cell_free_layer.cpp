#include "micro/ensemble/observables/cell_free_layer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace hemoscale::micro {
namespace {

struct Columns {
  double width;  // [m]
  std::vector<double> lowest, highest;

  /// Lets a column, counted from any period, see the height y.
  void see(double column, double y) {
    const auto count = static_cast<double>(lowest.size());
    const auto c = static_cast<std::size_t>(column - std::floor(column / count) * count);
    lowest[c] = std::min(lowest[c], y);
    highest[c] = std::max(highest[c], y);
  }

  /// A straight piece of membrane; every column sees the ends of the part within it.
  void see_piece(double x, double y, double to_x, double to_y) {
    if (to_x < x) {
      std::swap(x, to_x);
      std::swap(y, to_y);
    }
    const double first = std::floor(x / width);
    const double last = std::floor(to_x / width);
    see(first, y);
    for (double c = first; c < last; ++c) {
      const double border = y + (to_y - y) * ((c + 1) * width - x) / (to_x - x);
      see(c, border);
      see(c + 1, border);
    }
    see(last, to_y);
  }
};

}  // namespace

std::optional<EnvelopeLayer> envelope_layer(const EnsembleState& state, const Box& box,
                                            double column_width) {
  const double count = std::max(1.0, std::round(box.length / column_width));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto size = static_cast<std::size_t>(count);
  Columns columns{box.length / count, std::vector<double>(size, infinity),
                  std::vector<double>(size, -infinity)};
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    std::size_t before = (cell + 1) * state.nodes - 1;
    for (std::size_t i = cell * state.nodes; i < (cell + 1) * state.nodes; before = i++) {
      columns.see_piece(state.x[before], state.y[before], state.x[i], state.y[i]);
    }
  }
  EnvelopeLayer layer;
  double covered = 0;
  for (std::size_t c = 0; c < size; ++c) {
    if (columns.highest[c] >= columns.lowest[c]) {
      layer.lower += columns.lowest[c];
      layer.upper += box.height - columns.highest[c];
      ++covered;
    }
  }
  if (covered == 0) return std::nullopt;
  layer.lower /= covered;
  layer.upper /= covered;
  layer.covered = covered / count;
  return layer;
}

}  // namespace hemoscale::micro
