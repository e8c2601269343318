#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "micro/particles/periodic_box.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Resting points in square bins, found by place.
class NodeBins {
 public:
  /// @param size  least edge of a bin [m], positive
  /// @throws ParameterError if there is no point, or a periodic extent holds fewer than five bins
  NodeBins(std::vector<Vector<2>> points, const PeriodicBox<2>& box, double size);

  /// Calls visit(k, r) for every point k whose bin lies within `reach` bins of that of x; r = its
  /// nearest image minus x. The order depends on the bins alone.
  /// @param reach  at most 2
  template <typename Visit>
  void visit_around(const Vector<2>& x, int reach, const Visit& visit) const {
    const std::array<long, 2> centre = bin_of(x);
    for (long row = centre[1] - reach; row <= centre[1] + reach; ++row) {
      const long j = wrapped_bin(row, 1);
      if (j < 0) continue;
      for (long column = centre[0] - reach; column <= centre[0] + reach; ++column) {
        const long i = wrapped_bin(column, 0);
        if (i < 0) continue;
        const auto bin = static_cast<std::size_t>(j * counts_[0] + i);
        for (std::size_t n = first_[bin]; n < first_[bin + 1]; ++n) {
          const std::size_t k = order_[n];
          visit(k, separation(box_, x, points_[k]));
        }
      }
    }
  }

  const std::vector<Vector<2>>& points() const { return points_; }
  const PeriodicBox<2>& box() const { return box_; }
  const Vector<2>& lower() const { return lower_; }  // [m] corners of the bins
  const Vector<2>& upper() const { return upper_; }

 private:
  std::array<long, 2> bin_of(const Vector<2>& x) const;

  /// The bin along an axis, -1 beyond the ends.
  long wrapped_bin(long bin, std::size_t axis) const {
    if (bin >= 0 && bin < counts_[axis]) return bin;
    if (!box_.periodic[axis]) return -1;
    return bin < 0 ? bin + counts_[axis] : bin - counts_[axis];
  }

  std::vector<Vector<2>> points_;
  PeriodicBox<2> box_;
  Vector<2> lower_, upper_;
  std::array<long, 2> counts_ = {1, 1};
  std::vector<std::size_t> first_;  // of each bin in `order_`
  std::vector<std::size_t> order_;
};

}  // namespace hemoscale::micro
