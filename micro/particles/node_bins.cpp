#include "micro/particles/node_bins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "micro/error.hpp"

namespace hemoscale::micro {

template <int dim>
NodeBins<dim>::NodeBins(std::vector<Vector<dim>> points, const PeriodicBox<dim>& box, double size)
    : points_(std::move(points)), box_(box) {
  if (points_.empty()) throw ParameterError("there is no point to search for; add nodes");
  if (box.slide != 0) {
    throw ParameterError(
        "the box slides; points that are searched by place need resting images; use moving walls");
  }
  lower_ = upper_ = points_.front();
  for (const Vector<dim>& x : points_) {
    lower_ = lower_.cwiseMin(x);
    upper_ = upper_.cwiseMax(x);
  }
  for (std::size_t axis = 0; axis < dim_size; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    if (box.periodic[axis]) {
      lower_[a] = box.lower[a];
      upper_[a] = box.upper[a];
    }
    const double extent = upper_[a] - lower_[a];
    counts_[axis] = std::max(1L, static_cast<long>(std::floor(extent / size)));
    if (box.periodic[axis] && counts_[axis] < 5) {
      throw ParameterError(
          fmt::format("the box is {:g} m wide along axis {}; at least five bins of {:g} m are "
                      "needed; enlarge it",
                      extent, axis, size));
    }
  }
  std::vector<std::size_t> bins(points_.size());
  long count = 1;
  for (const long along : counts_) count *= along;
  first_.assign(static_cast<std::size_t>(count) + 1, 0);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Index at = bin_of(points_[k]);
    long bin = 0;
    for (std::size_t axis = dim_size; axis-- > 0;) bin = bin * counts_[axis] + at[axis];
    bins[k] = static_cast<std::size_t>(bin);
    ++first_[bins[k] + 1];
  }
  for (std::size_t bin = 1; bin < first_.size(); ++bin) first_[bin] += first_[bin - 1];
  order_.resize(points_.size());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t k = 0; k < points_.size(); ++k) order_[next[bins[k]]++] = k;
}

template <int dim>
typename NodeBins<dim>::Index NodeBins<dim>::bin_of(const Vector<dim>& x) const {
  const Vector<dim> y = wrapped(box_, x);
  Index bin = {};
  for (std::size_t axis = 0; axis < dim_size; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    const double extent = upper_[a] - lower_[a];
    const double place = extent > 0 ? (y[a] - lower_[a]) / extent : 0;
    const auto count = static_cast<double>(counts_[axis]);
    // Points far outside belong to the outermost bins; nothing is near them.
    bin[axis] = static_cast<long>(std::clamp(std::floor(place * count), 0.0, count - 1));
  }
  return bin;
}

template class NodeBins<2>;
template class NodeBins<3>;

}  // namespace hemoscale::micro
