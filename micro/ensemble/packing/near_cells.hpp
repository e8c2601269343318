#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "micro/ensemble/packing/cell_room.hpp"
#include "micro/ensemble/state.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Rectangle that holds a cell.
struct Bounds {
  double left = 0, right = 0, lower = 0, upper = 0;  // [m]

  bool meets(const Bounds& other) const {
    return left < other.right && other.left < right && lower < other.upper && other.lower < upper;
  }
  bool holds(const Bounds& other) const {
    return left <= other.left && right >= other.right && lower <= other.lower &&
           upper >= other.upper;
  }
  Bounds moved(const Vector<2>& by) const {
    return {left + by.x(), right + by.x(), lower + by.y(), upper + by.y()};
  }
  Bounds grown(double by) const { return {left - by, right + by, lower - by, upper + by}; }
  Vector<2> middle() const { return {0.5 * (left + right), 0.5 * (lower + upper)}; }
};

/// @pre as many x as y, at least one
Bounds bounds_of(std::span<const double> x, std::span<const double> y);
std::vector<Bounds> bounds_of(const EnsembleState& state);

/// Cells in bins by their middles, to find those that meet a rectangle; cost of a question does not
/// grow with the number of cells. Images are found wherever the room repeats itself, as many as
/// there are.
class NearCells {
 public:
  NearCells(std::vector<Bounds> cells, const CellRoom& room);

  /// Calls visit(cell, displacement) for every cell whose image at that displacement [m] meets the
  /// rectangle, in an order that depends on the cells alone.
  template <class Visit>
  void meeting(const Bounds& box, const Visit& visit) const {
    if (cells_.empty()) return;
    const auto bin = [](double place, double size) {
      return static_cast<std::int64_t>(std::floor(place / size));
    };
    const std::int64_t first_row = bin(box.lower - reach_.y() - origin_.y(), size_.y());
    const std::int64_t last_row = bin(box.upper + reach_.y() - origin_.y(), size_.y());
    for (std::int64_t r = first_row; r <= last_row; ++r) {
      const auto [row, y_image] = split(r, rows_, room_.repeats_along_y());
      if (row < 0) continue;
      const double slide = static_cast<double>(y_image) * room_.image_offset;
      const std::int64_t first = bin(box.left - slide - reach_.x() - origin_.x(), size_.x());
      const std::int64_t last = bin(box.right - slide + reach_.x() - origin_.x(), size_.x());
      for (std::int64_t c = first; c <= last; ++c) {
        const auto [column, x_image] = split(c, columns_, room_.length > 0);
        if (column < 0) continue;
        const Vector<2> image(static_cast<double>(x_image) * room_.length + slide,
                              static_cast<double>(y_image) * room_.height);
        const auto b = static_cast<std::size_t>(row * columns_ + column);
        for (std::size_t k = first_[b]; k < first_[b + 1]; ++k) {
          const std::size_t cell = order_[k];
          const Vector<2> displacement = home_[cell] + image;
          if (cells_[cell].moved(displacement).meets(box)) visit(cell, displacement);
        }
      }
    }
  }

  const std::vector<Bounds>& bounds() const { return cells_; }

 private:
  struct Split {
    std::int64_t bin;    // -1: outside
    std::int64_t image;  // number of periods
  };
  static Split split(std::int64_t k, std::int64_t bins, bool repeats) {
    if (k >= 0 && k < bins) return {k, 0};
    if (!repeats) return {-1, 0};
    const std::int64_t image = k >= 0 ? k / bins : -((bins - 1 - k) / bins);
    return {k - image * bins, image};
  }
  std::size_t bin_of(std::size_t cell) const;

  std::vector<Bounds> cells_;
  CellRoom room_;
  std::vector<Vector<2>> home_;           // [m] displacement into the home box
  Vector<2> origin_ = Vector<2>::Zero();  // [m] of the bins
  Vector<2> size_ = Vector<2>::Ones();    // [m] of a bin
  Vector<2> reach_ = Vector<2>::Zero();   // [m] half the largest cell
  std::int64_t columns_ = 1, rows_ = 1;
  std::vector<std::size_t> first_, order_;
};

}  // namespace hemoscale::micro
