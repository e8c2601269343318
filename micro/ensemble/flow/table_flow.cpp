#include "micro/ensemble/flow/table_flow.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

LocalFlow between(const LocalFlow& a, const LocalFlow& b, double share) {
  LocalFlow flow;
  flow.velocity = a.velocity + share * (b.velocity - a.velocity);
  flow.gradient = a.gradient + share * (b.gradient - a.gradient);
  for (std::size_t i = 0; i < 2; ++i) {
    flow.second[i] = a.second[i] + share * (b.second[i] - a.second[i]);
  }
  return flow;
}

}  // namespace

TableFlow::TableFlow(std::vector<double> times, std::vector<std::shared_ptr<const GivenFlow>> flows,
                     std::optional<double> period)
    : times_(std::move(times)), flows_(std::move(flows)), period_(period) {
  if (times_.size() != flows_.size() || times_.size() < 2) {
    throw ParameterError(
        fmt::format("flow in time: {} times for {} flows; there must be a time for each flow, at "
                    "least two; give both lists the same length",
                    times_.size(), flows_.size()));
  }
  for (std::size_t k = 0; k < times_.size(); ++k) {
    if (!std::isfinite(times_[k]) || (k > 0 && !(times_[k] > times_[k - 1]))) {
      throw ParameterError(
          fmt::format("flow in time: time {} is {} s; times must be finite and increase; sort them",
                      k, times_[k]));
    }
    if (!flows_[k]->is_steady()) {
      throw ParameterError(fmt::format(
          "flow in time: flow {} depends on the time itself; give the flow at that instant", k));
    }
    // Both are norms, hence largest at an end of each interval.
    largest_shear_rate_ = std::max(largest_shear_rate_, flows_[k]->largest_shear_rate());
    largest_speed_ = std::max(largest_speed_, flows_[k]->largest_speed());
  }
  const double span = times_.back() - times_.front();
  if (period_ && !(*period_ > span && std::isfinite(*period_))) {
    throw ParameterError(
        fmt::format("flow in time: period {} s; it must exceed the {} s from the first time to the "
                    "last; leave out the last flow if it equals the first",
                    *period_, span));
  }
}

LocalFlow TableFlow::at(const Vector<2>& x, double time) const {
  double t = time;
  if (period_) t -= *period_ * std::floor((time - times_.front()) / *period_);
  if (!period_ && !(t >= times_.front() && t <= times_.back())) {
    throw ParameterError(fmt::format(
        "flow in time: it is known from {} s to {} s, not at {} s; end the run earlier, "
        "give more flows or a period",
        times_.front(), times_.back(), time));
  }
  const auto after = std::upper_bound(times_.begin(), times_.end(), t);
  const auto next = static_cast<std::size_t>(std::distance(times_.begin(), after));
  if (next == 0) return flows_.front()->at(x, 0);  // a period may be left by rounding
  const std::size_t last = next - 1;
  if (next == times_.size() && !period_) return flows_[last]->at(x, 0);
  const double end = next == times_.size() ? times_.front() + *period_ : times_[next];
  const double share = (t - times_[last]) / (end - times_[last]);
  return between(flows_[last]->at(x, 0), flows_[next % flows_.size()]->at(x, 0), share);
}

}  // namespace hemoscale::micro
