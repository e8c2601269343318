#include "micro/stress/series_estimate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

/// Summed relative to the first sample: exact for a constant.
double mean_of(std::span<const double> series) {
  const double origin = series.front();
  const double sum = std::accumulate(series.begin(), series.end(), 0.0,
                                     [&](double s, double value) { return s + (value - origin); });
  return origin + sum / static_cast<double>(series.size());
}

/// Mean product of deviations `lag` samples apart.
double covariance(const std::vector<double>& deviation, std::size_t lag) {
  double sum = 0;
  const std::size_t pairs = deviation.size() - lag;
  for (std::size_t i = 0; i < pairs; ++i) {
    sum += deviation[i] * deviation[i + lag];
  }
  return sum / static_cast<double>(pairs);
}

}  // namespace

Estimate estimate_mean(std::span<const double> series, double spacing) {
  assert(!series.empty());
  const auto n = static_cast<double>(series.size());
  Estimate estimate;
  estimate.mean = mean_of(series);
  if (series.size() == 1) {
    estimate.standard_error = std::numeric_limits<double>::infinity();
    estimate.effective_samples = 1;
    return estimate;
  }
  std::vector<double> deviation(series.begin(), series.end());
  for (double& value : deviation) {
    value -= estimate.mean;
  }
  const double variance = covariance(deviation, 0);
  // Scatter at the level of round-off has no correlation that could be measured.
  const double roundoff = 4 * std::numeric_limits<double>::epsilon() * std::abs(estimate.mean);
  if (variance <= roundoff * roundoff) {
    estimate.correlation_time = 0.5 * spacing;
    estimate.effective_samples = n;
    return estimate;
  }
  // Beyond half of the series the correlations are noise of few pairs.
  constexpr double windows_per_tau = 5;
  double tau = 0.5;
  std::size_t window = 0;
  while (window < series.size() / 2 && static_cast<double>(window) < windows_per_tau * tau) {
    ++window;
    tau += covariance(deviation, window) / variance;
  }
  tau *= 1 + (2 * static_cast<double>(window) + 1) / n;
  // Antithetic correlation is not credited: the error is at least that of independent samples.
  tau = std::max(tau, 0.5);
  estimate.correlation_time = tau * spacing;
  estimate.effective_samples = n / (2 * tau);
  estimate.standard_error = std::sqrt(variance / estimate.effective_samples);
  return estimate;
}

double block_standard_error(std::span<const double> series, int blocks) {
  if (blocks < 2 || static_cast<std::size_t>(blocks) > series.size()) {
    throw ParameterError(fmt::format(
        "{} blocks of {} samples; at least two blocks and at most as many as samples are "
        "possible; choose another number of blocks",
        blocks, series.size()));
  }
  const auto count = static_cast<std::size_t>(blocks);
  const std::size_t length = series.size() / count;
  std::vector<double> averages(count);
  for (std::size_t i = 0; i < count; ++i) {
    averages[i] = mean_of(series.subspan(i * length, length));
  }
  const double mean = mean_of(averages);
  double sum = 0;
  for (const double average : averages) {
    sum += (average - mean) * (average - mean);
  }
  return std::sqrt(sum / (static_cast<double>(blocks) * (blocks - 1)));
}

}  // namespace hemoscale::micro
