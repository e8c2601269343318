#include "micro/particles/rearrange.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace hemoscale::micro {

template <int dim>
std::vector<std::int32_t> spatial_order(const std::vector<Vector<dim>>& positions, double cell) {
  std::vector<std::int32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0);
  if (positions.empty()) return order;
  Vector<dim> lower = positions.front();
  for (const Vector<dim>& x : positions) lower = lower.cwiseMin(x);

  // Cells are compared from the last axis to the first, so that a row runs along the first axis;
  // within a cell the former order holds.
  using Key = std::array<std::int64_t, static_cast<std::size_t>(dim)>;
  std::vector<Key> keys(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (int axis = 0; axis < dim; ++axis) {
      keys[i][static_cast<std::size_t>(dim - 1 - axis)] =
          static_cast<std::int64_t>(std::floor((positions[i][axis] - lower[axis]) / cell));
    }
  }
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return keys[static_cast<std::size_t>(a)] < keys[static_cast<std::size_t>(b)];
  });
  return order;
}

template std::vector<std::int32_t> spatial_order<2>(const std::vector<Vector<2>>&, double);
template std::vector<std::int32_t> spatial_order<3>(const std::vector<Vector<3>>&, double);

}  // namespace hemoscale::micro
