#include "micro/linear/ordering.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

Bandwidth bandwidth_of(const SparsePattern& pattern, const std::vector<std::int32_t>& place) {
  std::int32_t lower = 0;
  std::int32_t upper = 0;
  for (std::size_t i = 0; i < pattern.rows(); ++i) {
    for (auto k = pattern.first[i]; k < pattern.first[i + 1]; ++k) {
      const auto column = static_cast<std::size_t>(pattern.columns[static_cast<std::size_t>(k)]);
      lower = std::max(lower, place[i] - place[column]);
      upper = std::max(upper, place[column] - place[i]);
    }
  }
  return {static_cast<std::size_t>(lower), static_cast<std::size_t>(upper)};
}

// The sort key s of every node; with `columns`, x is rounded to whole spacings.
template <int dim>
std::vector<double> sweep(const NodeLayout<dim>& layout, int axis, bool columns) {
  Vector<dim> lower = layout.positions.front();
  Vector<dim> upper = lower;
  for (const Vector<dim>& x : layout.positions) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  Vector<dim> weights = Vector<dim>::Zero();  // of the coordinates in s
  weights[axis] = 1;
  double tilt = 1;
  for (int step = 1; step < dim; ++step) {
    const int across = (axis + step) % dim;
    tilt *= 0.5 * layout.spacing / std::max(upper[across] - lower[across], layout.spacing);
    weights[across] = tilt;
  }
  const double period = layout.period[axis];
  std::vector<double> keys(layout.positions.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    double key = 0;
    for (int a = 0; a < dim; ++a) {
      double x = layout.positions[i][a] - lower[a];
      if (a == axis && period > 0) {
        x -= period * std::floor(x / period);
        x = std::min(x, period - x);
      }
      if (a == axis && columns) {
        x = layout.spacing * std::round(x / layout.spacing);
      }
      key += weights[a] * x;
    }
    keys[i] = key;
  }
  return keys;
}

std::vector<std::int32_t> places_by(const std::vector<double>& keys, int unknowns_per_node) {
  std::vector<std::int32_t> nodes(keys.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  std::sort(nodes.begin(), nodes.end(), [&](std::int32_t a, std::int32_t b) {
    const double first = keys[static_cast<std::size_t>(a)];
    const double second = keys[static_cast<std::size_t>(b)];
    return first < second || (first == second && a < b);
  });
  std::vector<std::int32_t> place(keys.size() * static_cast<std::size_t>(unknowns_per_node));
  std::int32_t next = 0;
  const auto per_node = static_cast<std::size_t>(unknowns_per_node);
  for (const std::int32_t node : nodes) {
    for (std::size_t k = 0; k < per_node; ++k) {
      place[static_cast<std::size_t>(node) * per_node + k] = next++;
    }
  }
  return place;
}

}  // namespace

Ordering natural_order(const SparsePattern& pattern) {
  Ordering order;
  order.place.resize(pattern.global_rows);
  std::iota(order.place.begin(), order.place.end(), 0);
  order.bandwidth = bandwidth_of(pattern, order.place);
  return order;
}

template <int dim>
Ordering column_order(const SparsePattern& pattern, const NodeLayout<dim>& layout,
                      int unknowns_per_node) {
  if (!pattern.is_whole() || unknowns_per_node < 1 || layout.positions.empty() ||
      pattern.rows() != layout.positions.size() * static_cast<std::size_t>(unknowns_per_node) ||
      !(layout.spacing > 0)) {
    throw ParameterError(fmt::format(
        "an order by columns needs all rows of the system, one or more nodes of positive spacing, "
        "and as many rows as nodes times unknowns; got {} of {} rows, {} nodes with {} unknowns "
        "each, spacing {:.4g} m",
        pattern.rows(), pattern.global_rows, layout.positions.size(), unknowns_per_node,
        layout.spacing));
  }
  Ordering best;
  // What the factors hold a column.
  const auto width = [](const Bandwidth& band) { return 2 * band.lower + band.upper; };
  for (int axis = 0; axis < dim; ++axis) {
    for (const bool columns : {false, true}) {
      Ordering order;
      order.place = places_by(sweep(layout, axis, columns), unknowns_per_node);
      order.bandwidth = bandwidth_of(pattern, order.place);
      if (best.place.empty() || width(order.bandwidth) < width(best.bandwidth)) {
        best = std::move(order);
      }
    }
  }
  return best;
}

template Ordering column_order<2>(const SparsePattern&, const NodeLayout<2>&, int);
template Ordering column_order<3>(const SparsePattern&, const NodeLayout<3>&, int);

}  // namespace hemoscale::micro
