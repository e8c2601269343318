#include "coupling/scheme/shear_groups.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

namespace hemoscale::coupling {

namespace {

bool is_within(double a, double b, double ratio) {
  return a <= b * ratio && b <= a * ratio;
}

// The run of the points `members` (numbers in `flows`), which share one hematocrit.
PlannedRun shared_run(const std::vector<ShearForcing>& flows,
                      const std::vector<std::size_t>& members) {
  const std::size_t slot = *std::min_element(members.begin(), members.end());
  if (members.size() == 1) return {static_cast<int>(slot), flows[slot]};
  double mean_log = 0;
  for (const std::size_t i : members) {
    mean_log += std::log(flows[i].shear_rate) / double(members.size());
  }
  return {static_cast<int>(slot), simple_shear(std::exp(mean_log), flows[slot].forcing.hematocrit)};
}

}  // namespace

ShearGroups group_by_shear_rate(const std::vector<ShearForcing>& flows, double distinct_ratio,
                                double lowest_shear_rate) {
  assert(distinct_ratio >= 1 && lowest_shear_rate > 0);
  ShearGroups result;
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < flows.size(); ++i) {
    if (flows[i].shear_rate < lowest_shear_rate) {
      ++result.points_below_lowest;
    } else {
      points.push_back(i);
    }
  }
  std::sort(points.begin(), points.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(flows[a].forcing.hematocrit, flows[a].shear_rate, a) <
           std::tie(flows[b].forcing.hematocrit, flows[b].shear_rate, b);
  });
  std::vector<std::size_t> group;
  for (const std::size_t i : points) {
    const bool joins = !group.empty() &&
                       flows[i].forcing.hematocrit == flows[group.front()].forcing.hematocrit &&
                       flows[i].shear_rate <= flows[group.front()].shear_rate * distinct_ratio;
    if (!group.empty() && !joins) {
      result.runs.push_back(shared_run(flows, group));
      group.clear();
    }
    group.push_back(i);
  }
  if (!group.empty()) result.runs.push_back(shared_run(flows, group));
  return result;
}

bool is_covered(const ShearForcing& flow, const std::vector<RheologySample>& samples,
                double distinct_ratio, double relative_standard_error) {
  double weights = 0;  // of log viscosity: (viscosity / error)^2
  for (const RheologySample& s : samples) {
    if (s.hematocrit != flow.forcing.hematocrit ||
        !is_within(s.shear_rate, flow.shear_rate, distinct_ratio)) {
      continue;
    }
    if (s.precision_reached || s.viscosity_error == 0) return true;
    weights += s.viscosity * s.viscosity / (s.viscosity_error * s.viscosity_error);
  }
  return weights > 0 && 1 / std::sqrt(weights) <= relative_standard_error;
}

}  // namespace hemoscale::coupling
