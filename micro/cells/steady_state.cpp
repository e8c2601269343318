#include "micro/cells/steady_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "micro/error.hpp"

namespace hemoscale::micro {

namespace {

void require_series(std::span<const double> time, std::span<const double> progress,
                    std::span<const double> values, const SteadyCriterion& criterion) {
  if (!(criterion.tolerance > 0) || !(criterion.window > 0)) {
    throw ParameterError(
        fmt::format("tolerance {} and window {} of a steady state; both are positive",
                    criterion.tolerance, criterion.window));
  }
  if (time.size() != progress.size() || time.size() != values.size()) {
    throw ParameterError(
        fmt::format("{} times, {} steps of progress and {} values; give as many of each",
                    time.size(), progress.size(), values.size()));
  }
  for (std::size_t i = 0; i < time.size(); ++i) {
    const bool ascends = i == 0 || (time[i] > time[i - 1] && progress[i] >= progress[i - 1]);
    if (!ascends || !std::isfinite(time[i]) || !std::isfinite(progress[i]) ||
        !std::isfinite(values[i])) {
      throw ParameterError(
          fmt::format("sample {} of a series: time {}, progress {}, value {}; times and progress "
                      "ascend, and all "
                      "are finite",
                      i, time[i], progress[i], values[i]));
    }
  }
}

struct Fit {
  double final_value = 0;
  double residual = 0;  // sum of squares
};

// Least squares of f + a exp(-rate q) for a given rate; q is the progress over the window, from its
// end, so that the exponential is one there.
Fit fit_with_rate(std::span<const double> q, std::span<const double> values, double rate) {
  const auto n = static_cast<double>(q.size());
  double mean_shape = 0;
  double mean_value = 0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    mean_shape += std::exp(-rate * q[i]) / n;
    mean_value += values[i] / n;
  }
  double square = 0;
  double product = 0;
  double total = 0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const double shape = std::exp(-rate * q[i]) - mean_shape;
    const double value = values[i] - mean_value;
    square += shape * shape;
    product += shape * value;
    total += value * value;
  }
  const double amplitude = product / square;
  // The last expression can round to below zero for a perfect fit.
  return {mean_value - amplitude * mean_shape, std::max(0.0, total - amplitude * product)};
}

constexpr double slowest = 0.05;  // [-] rates per window
constexpr double fastest = 20;

// The best rate: scan, then golden section around the best point of the scan, in the logarithm.
Fit best_fit(std::span<const double> q, std::span<const double> values) {
  constexpr int points = 40;
  const double step = std::log(fastest / slowest) / points;
  const auto at = [&](double x) { return fit_with_rate(q, values, slowest * std::exp(x * step)); };
  int best = 0;
  for (int k = 1; k <= points; ++k) {
    if (at(k).residual < at(best).residual) best = k;
  }
  double low = std::max(0, best - 1);
  double high = std::min(points, best + 1);
  const double ratio = std::numbers::phi - 1;
  while (high - low > 1e-4) {
    const double a = high - ratio * (high - low);
    const double b = low + ratio * (high - low);
    if (at(a).residual < at(b).residual) {
      high = b;
    } else {
      low = a;
    }
  }
  return at((low + high) / 2);
}

// What the last window tends to.
double limit_of(std::span<const double> q, std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0;
  for (const double value : values) mean += value / n;
  double scatter = 0;
  for (const double value : values) scatter += (value - mean) * (value - mean);
  const Fit fit = best_fit(q, values);
  // Two more parameters reduce the sum of squares of white noise by 2 of n on average; by the
  // factor below in about one of 10^4 series (chi^2 of two degrees of freedom above 18.4).
  const bool has_trend = fit.residual * (1 + 18.4 / (n - 3)) < scatter;
  return has_trend ? fit.final_value : mean;
}

double settling_time(std::span<const double> time, std::span<const double> values, double limit,
                     double band) {
  std::size_t i = values.size() - 1;
  while (i > 0 && std::abs(values[i - 1] - limit) <= band) --i;
  if (i == 0) return time[0];
  const double outside = std::abs(values[i - 1] - limit);
  const double inside = (values[i] > limit) == (values[i - 1] > limit)
                            ? std::abs(values[i] - limit)
                            : -std::abs(values[i] - limit);
  return time[i - 1] + (outside - band) / (outside - inside) * (time[i] - time[i - 1]);
}

}  // namespace

SteadyState find_steady_state(std::span<const double> time, std::span<const double> progress,
                              std::span<const double> values, const SteadyCriterion& criterion) {
  require_series(time, progress, values, criterion);
  SteadyState state;
  if (values.empty()) return state;
  state.final_value = values.back();
  const double end = progress.back();
  std::size_t first = values.size() - 1;
  while (first > 0 && progress[first - 1] >= end - criterion.window) --first;
  const std::span<const double> last = values.subspan(first);
  if (end - progress.front() < 2 * criterion.window || last.size() < 8) return state;

  std::vector<double> q;
  for (std::size_t i = first; i < progress.size(); ++i) {
    q.push_back((progress[i] - end) / criterion.window);
  }
  state.final_value = limit_of(q, last);
  const double scale = std::abs(state.final_value);
  const auto [smallest, largest] = std::minmax_element(last.begin(), last.end());
  state.remaining = std::abs(state.final_value - last.back()) / scale;
  state.change = (*largest - *smallest) / scale;
  const double band = criterion.tolerance * scale;
  if (*largest <= state.final_value + band && *smallest >= state.final_value - band) {
    state.steadiness = Steadiness::settled;
    state.settling_time = settling_time(time, values, state.final_value, band);
  } else if (*largest - *smallest <= 2 * criterion.tolerance * std::abs(last.back())) {
    state.steadiness = Steadiness::approaching;
  } else {
    state.steadiness = Steadiness::changing;
  }
  return state;
}

}  // namespace hemoscale::micro
