#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "micro/particles/periodic_box.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Resting points in bins of a grid, found by place.
template <int dim>
class NodeBins {
 public:
  /// @param size  least edge of a bin [m], positive
  /// @throws ParameterError if there is no point, the box slides, or a periodic extent holds fewer
  ///         than five bins
  NodeBins(std::vector<Vector<dim>> points, const PeriodicBox<dim>& box, double size);

  /// Calls visit(k, r) for every point k whose bin lies within `reach` bins of that of x; r = its
  /// nearest image minus x. The order depends on the bins alone.
  /// @param reach  at most 2
  template <typename Visit>
  void visit_around(const Vector<dim>& x, int reach, const Visit& visit) const {
    const Index centre = bin_of(x);
    const int width = 2 * reach + 1;
    int cells = 1;
    for (int axis = 0; axis < dim; ++axis) cells *= width;
    for (int cell = 0; cell < cells; ++cell) {
      long bin = 0;
      int rest = cell;
      std::array<long, dim_size> at = {};
      for (std::size_t axis = 0; axis < dim_size; ++axis) {
        at[axis] = wrapped_bin(centre[axis] + rest % width - reach, axis);
        rest /= width;
      }
      for (std::size_t axis = dim_size; axis-- > 0 && bin >= 0;) {
        bin = at[axis] < 0 ? -1 : bin * counts_[axis] + at[axis];
      }
      if (bin < 0) continue;
      const auto b = static_cast<std::size_t>(bin);
      for (std::size_t n = first_[b]; n < first_[b + 1]; ++n) {
        visit(order_[n], separation(box_, x, points_[order_[n]]));
      }
    }
  }

  const std::vector<Vector<dim>>& points() const { return points_; }
  const PeriodicBox<dim>& box() const { return box_; }
  const Vector<dim>& lower() const { return lower_; }  // [m] corners of the bins
  const Vector<dim>& upper() const { return upper_; }

 private:
  static constexpr auto dim_size = static_cast<std::size_t>(dim);
  using Index = std::array<long, dim_size>;

  Index bin_of(const Vector<dim>& x) const;

  /// The bin along an axis, -1 beyond the ends.
  long wrapped_bin(long bin, std::size_t axis) const {
    if (bin >= 0 && bin < counts_[axis]) return bin;
    if (!box_.periodic[axis]) return -1;
    return bin < 0 ? bin + counts_[axis] : bin - counts_[axis];
  }

  std::vector<Vector<dim>> points_;
  PeriodicBox<dim> box_;
  Vector<dim> lower_, upper_;  // [m]
  Index counts_ = {};
  std::vector<std::size_t> first_;  // of each bin in `order_`
  std::vector<std::size_t> order_;
};

}  // namespace hemoscale::micro
