#include "micro/immersed/node_bins.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "micro/error.hpp"

namespace hemoscale::micro {

NodeBins::NodeBins(std::vector<Vector<2>> points, const PeriodicBox<2>& box, double size)
    : points_(std::move(points)), box_(box) {
  if (points_.empty()) throw ParameterError("there is no point to search for; add nodes");
  if (box.slide != 0) {
    throw ParameterError(
        "the box slides; membranes need resting images; shear them between moving walls instead");
  }
  lower_ = upper_ = points_.front();
  for (const Vector<2>& x : points_) {
    lower_ = lower_.cwiseMin(x);
    upper_ = upper_.cwiseMax(x);
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    if (box.periodic[axis]) {
      lower_[a] = box.lower[a];
      upper_[a] = box.upper[a];
    }
    const double extent = upper_[a] - lower_[a];
    counts_[axis] = std::max(1L, static_cast<long>(std::floor(extent / size)));
    if (box.periodic[axis] && counts_[axis] < 5) {
      throw ParameterError(
          fmt::format("the box is {:g} m wide along axis {}; membranes need at least five spacings "
                      "of {:g} m; enlarge it",
                      extent, axis, size));
    }
  }
  std::vector<std::size_t> bins(points_.size());
  first_.assign(static_cast<std::size_t>(counts_[0] * counts_[1]) + 1, 0);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const std::array<long, 2> bin = bin_of(points_[k]);
    bins[k] = static_cast<std::size_t>(bin[1] * counts_[0] + bin[0]);
    ++first_[bins[k] + 1];
  }
  for (std::size_t bin = 1; bin < first_.size(); ++bin) first_[bin] += first_[bin - 1];
  order_.resize(points_.size());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t k = 0; k < points_.size(); ++k) order_[next[bins[k]]++] = k;
}

std::array<long, 2> NodeBins::bin_of(const Vector<2>& x) const {
  const Vector<2> y = wrapped(box_, x);
  std::array<long, 2> bin = {};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    const double extent = upper_[a] - lower_[a];
    const double place = extent > 0 ? (y[a] - lower_[a]) / extent : 0;
    const auto count = static_cast<double>(counts_[axis]);
    // Points far outside belong to the outermost bins; nothing is near them.
    bin[axis] = static_cast<long>(std::clamp(std::floor(place * count), 0.0, count - 1));
  }
  return bin;
}

}  // namespace hemoscale::micro
