#include "micro/ensemble/packing/near_cells.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace hemoscale::micro {

Bounds bounds_of(std::span<const double> x, std::span<const double> y) {
  const auto [left, right] = std::minmax_element(x.begin(), x.end());
  const auto [lower, upper] = std::minmax_element(y.begin(), y.end());
  return {*left, *right, *lower, *upper};
}

std::vector<Bounds> bounds_of(const EnsembleState& state) {
  std::vector<Bounds> bounds;
  bounds.reserve(state.cells);
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    bounds.push_back(bounds_of(std::span(state.x).subspan(cell * state.nodes, state.nodes),
                               std::span(state.y).subspan(cell * state.nodes, state.nodes)));
  }
  return bounds;
}

NearCells::NearCells(std::vector<Bounds> cells, const CellRoom& room)
    : cells_(std::move(cells)), room_(room) {
  constexpr double none = std::numeric_limits<double>::max();
  Vector<2> lowest(none, none);
  Vector<2> highest(-none, -none);
  for (const Bounds& b : cells_) {
    reach_ = reach_.cwiseMax(Vector<2>(0.5 * (b.right - b.left), 0.5 * (b.upper - b.lower)));
    Vector<2> middle = b.middle();
    Vector<2> home = Vector<2>::Zero();
    if (room_.repeats_along_y()) {
      const double periods = -std::floor(middle.y() / room_.height);
      home += periods * Vector<2>(room_.image_offset, room_.height);
    }
    if (room_.length > 0) {
      home.x() -= std::floor((middle.x() + home.x()) / room_.length) * room_.length;
    }
    home_.push_back(home);
    lowest = lowest.cwiseMin(middle + home);
    highest = highest.cwiseMax(middle + home);
  }
  if (cells_.empty()) return;
  // About a cell in every bin, and no bin smaller than a cell.
  const Vector<2> extent(room_.length > 0 ? room_.length : highest.x() - lowest.x(),
                         room_.repeats_along_y() ? room_.height : highest.y() - lowest.y());
  const auto bins = [&](double length, double least) {
    const double wanted = std::max(
        2 * least, std::sqrt(extent.x() * extent.y() / static_cast<double>(cells_.size())));
    const auto fitting = wanted > 0 ? static_cast<std::int64_t>(length / wanted) : 1;
    return std::clamp<std::int64_t>(fitting, 1, 1 << 20);
  };
  columns_ = bins(extent.x(), reach_.x());
  rows_ = bins(extent.y(), reach_.y());
  origin_ = {room_.length > 0 ? 0 : lowest.x(), room_.repeats_along_y() ? 0 : lowest.y()};
  // Where nothing repeats, cells in one row have bins as high as they are.
  const auto size = [](double length, std::int64_t count, bool repeats, double reach) {
    const double even = length / static_cast<double>(count);
    return repeats ? even : std::max({even, 2 * reach, std::numeric_limits<double>::min()});
  };
  size_ = {size(extent.x(), columns_, room_.length > 0, reach_.x()),
           size(extent.y(), rows_, room_.repeats_along_y(), reach_.y())};
  first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) ++first_[bin_of(cell) + 1];
  for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  order_.resize(cells_.size());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) order_[next[bin_of(cell)]++] = cell;
}

std::size_t NearCells::bin_of(std::size_t cell) const {
  const Vector<2> place = cells_[cell].middle() + home_[cell] - origin_;
  // The rightmost and uppermost cells lie on the edge of the last bin.
  const auto at = [](double x, double size, std::int64_t count) {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(x / size), 0, count - 1);
  };
  return static_cast<std::size_t>(at(place.y(), size_.y(), rows_) * columns_ +
                                  at(place.x(), size_.x(), columns_));
}

}  // namespace hemoscale::micro
