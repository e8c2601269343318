#include "micro/ensemble/interpenetration.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hemoscale::micro {
namespace {

struct Bounds {
  double left, right, lower, upper;  // [m]
};

Bounds bounds_of(const EnsembleState& state, std::size_t cell) {
  const auto first = static_cast<std::ptrdiff_t>(cell * state.nodes);
  const auto last = first + static_cast<std::ptrdiff_t>(state.nodes);
  const auto [left, right] = std::minmax_element(state.x.begin() + first, state.x.begin() + last);
  const auto [lower, upper] = std::minmax_element(state.y.begin() + first, state.y.begin() + last);
  return {*left, *right, *lower, *upper};
}

/// Even-odd rule along the ray to the right.
bool is_inside(const EnsembleState& state, std::size_t cell, double x, double y) {
  const std::size_t first = cell * state.nodes;
  bool inside = false;
  for (std::size_t k = 0, before = state.nodes - 1; k < state.nodes; before = k++) {
    const std::size_t a = first + before;
    const std::size_t b = first + k;
    if ((state.y[a] > y) != (state.y[b] > y)) {
      const double crossing =
          state.x[a] + (y - state.y[a]) / (state.y[b] - state.y[a]) * (state.x[b] - state.x[a]);
      inside = inside != (x < crossing);
    }
  }
  return inside;
}

/// Nodes of `other`, displaced by (dx, dy), inside `cell`.
std::size_t count_inside(const EnsembleState& state, std::size_t cell, const Bounds& bounds,
                         std::size_t other, double dx, double dy) {
  std::size_t count = 0;
  for (std::size_t i = other * state.nodes; i < (other + 1) * state.nodes; ++i) {
    const double x = state.x[i] + dx;
    const double y = state.y[i] + dy;
    if (x > bounds.left && x < bounds.right && y > bounds.lower && y < bounds.upper &&
        is_inside(state, cell, x, y)) {
      ++count;
    }
  }
  return count;
}

}  // namespace

std::size_t count_interpenetrating_nodes(const EnsembleState& state, const Box& box) {
  std::vector<Bounds> bounds;
  bounds.reserve(state.cells);
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    bounds.push_back(bounds_of(state, cell));
  }
  std::size_t count = 0;
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    const Bounds& a = bounds[cell];
    for (std::size_t other = 0; other < state.cells; ++other) {
      const Bounds& b = bounds[other];
      const int lowest =
          box.walls ? 0 : static_cast<int>(std::ceil((a.lower - b.upper) / box.height));
      const int highest =
          box.walls ? 0 : static_cast<int>(std::floor((a.upper - b.lower) / box.height));
      for (int row = lowest; row <= highest; ++row) {
        const double slide = row * state.image_offset;
        const int first = static_cast<int>(std::ceil((a.left - b.right - slide) / box.length));
        const int last = static_cast<int>(std::floor((a.right - b.left - slide) / box.length));
        for (int column = first; column <= last; ++column) {
          if (other == cell && row == 0 && column == 0) {
            continue;
          }
          count +=
              count_inside(state, cell, a, other, slide + column * box.length, row * box.height);
        }
      }
    }
  }
  return count;
}

}  // namespace hemoscale::micro
