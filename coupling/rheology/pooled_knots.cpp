#include "coupling/rheology/pooled_knots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace hemoscale::coupling {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Uncertain log_viscosity(const RheologySample& sample) {
  return {std::log(sample.viscosity), sample.viscosity_error / sample.viscosity};
}

// Sorted by hematocrit, then shear rate, then viscosity, so that the table does not depend on the
// order in which samples arrived.
std::vector<RheologySample> sorted(std::vector<RheologySample> samples) {
  std::sort(samples.begin(), samples.end(), [](const RheologySample& a, const RheologySample& b) {
    return std::tie(a.hematocrit, a.shear_rate, a.viscosity, a.viscosity_error) <
           std::tie(b.hematocrit, b.shear_rate, b.viscosity, b.viscosity_error);
  });
  return samples;
}

// Splits a sorted list where `starts_group(first of group, candidate)` says so.
template <class StartsGroup>
std::vector<std::vector<RheologySample>> split(const std::vector<RheologySample>& samples,
                                               const StartsGroup& starts_group) {
  std::vector<std::vector<RheologySample>> groups;
  for (const RheologySample& s : samples) {
    if (groups.empty() || starts_group(groups.back().front(), s)) groups.emplace_back();
    groups.back().push_back(s);
  }
  return groups;
}

}  // namespace

std::vector<std::vector<SampleGroup>> groups_by_row(const std::vector<RheologySample>& samples,
                                                    const Pooling& pooling) {
  const auto new_row = [&](const RheologySample& first, const RheologySample& s) {
    return s.hematocrit > first.hematocrit + pooling.hematocrit;
  };
  const auto new_knot = [&](const RheologySample& first, const RheologySample& s) {
    return s.shear_rate > first.shear_rate * pooling.shear_ratio;
  };
  std::vector<std::vector<SampleGroup>> rows;
  for (std::vector<RheologySample>& row : split(sorted(samples), new_row)) {
    std::stable_sort(row.begin(), row.end(), [](const RheologySample& a, const RheologySample& b) {
      return a.shear_rate < b.shear_rate;
    });
    rows.push_back(split(row, new_knot));
  }
  return rows;
}

Knot pool(const SampleGroup& samples) {
  if (samples.size() == 1) {
    return {samples[0].shear_rate, log_viscosity(samples[0]), degrees_of_freedom(samples[0])};
  }
  std::vector<Uncertain> rates;
  std::vector<Uncertain> values;
  for (const RheologySample& s : samples) {
    values.push_back(log_viscosity(s));
    rates.push_back({std::log(s.shear_rate), values.back().error});
  }
  Knot knot;
  const std::size_t last = samples.size() - 1;
  knot.shear_rate = std::clamp(std::exp(weighted_mean(rates, 0, last)), samples.front().shear_rate,
                               samples.back().shear_rate);  // undoes rounding, no more
  knot.log_viscosity.value = weighted_mean(values, 0, last);

  const bool exact =
      std::any_of(values.begin(), values.end(), [](const Uncertain& x) { return x.error == 0; });
  if (exact) {
    knot.degrees_of_freedom = infinity;
    return knot;
  }
  double weights = 0;
  for (const Uncertain& x : values) weights += 1 / (x.error * x.error);
  double inverse_freedom = 0;  // Welch 1947
  double inflation = 1;        // Meier 1953: the weights are themselves estimates
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double share = 1 / (values[i].error * values[i].error * weights);
    const double freedom = degrees_of_freedom(samples[i]);
    inverse_freedom += share * share / freedom;
    inflation += 4 * share * (1 - share) / freedom;
  }
  knot.log_viscosity.error = std::sqrt(inflation / weights);
  knot.degrees_of_freedom = 1 / inverse_freedom;
  return knot;
}

double mean_hematocrit(const std::vector<SampleGroup>& row) {
  double sum = 0;
  double lowest = infinity;
  double highest = 0;
  double count = 0;
  for (const SampleGroup& group : row) {
    for (const RheologySample& s : group) {
      sum += s.hematocrit;
      lowest = std::min(lowest, s.hematocrit);
      highest = std::max(highest, s.hematocrit);
      ++count;
    }
  }
  return std::clamp(sum / count, lowest, highest);  // undoes rounding: equal values stay themselves
}

}  // namespace hemoscale::coupling
