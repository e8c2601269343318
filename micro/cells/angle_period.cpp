#include "micro/cells/angle_period.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "micro/error.hpp"

namespace hemoscale::micro {

namespace {

void require_pairs(std::span<const double> time, std::span<const double> values) {
  if (time.size() == values.size()) return;
  throw ParameterError(
      fmt::format("{} times for {} values; give one for each", time.size(), values.size()));
}

std::optional<Period> between(const std::vector<double>& passages) {
  if (passages.size() < 2) return std::nullopt;
  Period period;
  period.count = static_cast<int>(passages.size()) - 1;
  period.mean = (passages.back() - passages.front()) / period.count;
  if (period.count > 1) {
    double square = 0;
    for (std::size_t i = 1; i < passages.size(); ++i) {
      square += std::pow(passages[i] - passages[i - 1] - period.mean, 2);
    }
    period.scatter = std::sqrt(square / (period.count - 1));
  }
  return period;
}

double passage(std::span<const double> time, std::span<const double> values, std::size_t i,
               double level) {
  return time[i - 1] +
         (level - values[i - 1]) / (values[i] - values[i - 1]) * (time[i] - time[i - 1]);
}

}  // namespace

std::vector<double> unwrapped(std::span<const double> angles, double symmetry) {
  std::vector<double> result(angles.begin(), angles.end());
  for (std::size_t i = 1; i < result.size(); ++i) {
    result[i] -= symmetry * std::round((result[i] - result[i - 1]) / symmetry);
    const double change = result[i] - result[i - 1];
    if (!(std::abs(change) <= symmetry / 3)) {
      throw ParameterError(fmt::format(
          "an angle changes by {:.3g} rad between samples {} and {}, more than a third of "
          "{:.3g}: its direction is not known; sample more often",
          change, i - 1, i, symmetry));
    }
  }
  return result;
}

std::optional<Period> turning_period(std::span<const double> time, std::span<const double> angles,
                                     double level) {
  require_pairs(time, angles);
  if (angles.empty()) return std::nullopt;
  constexpr double turn = 2 * std::numbers::pi;
  const double sense = angles.back() >= angles.front() ? 1 : -1;
  // In units of turns and in the sense of the motion, levels are whole numbers.
  std::vector<double> turns;
  for (const double angle : angles) turns.push_back(sense * (angle - level) / turn);
  std::vector<double> passages;
  // A level counts if the series begins below it and ends above.
  for (double whole = std::floor(turns.front()) + 1; whole < turns.back(); ++whole) {
    double first = 0;
    double last = 0;
    bool is_passed = false;
    for (std::size_t i = 1; i < turns.size(); ++i) {
      if ((turns[i - 1] < whole) == (turns[i] < whole)) continue;
      last = passage(time, turns, i, whole);
      if (!is_passed) first = last;
      is_passed = true;
    }
    passages.push_back((first + last) / 2);
  }
  return between(passages);
}

std::optional<Period> oscillation_period(std::span<const double> time,
                                         std::span<const double> values) {
  require_pairs(time, values);
  if (values.empty()) return std::nullopt;
  const auto [smallest, largest] = std::minmax_element(values.begin(), values.end());
  const double middle = (*smallest + *largest) / 2;
  const double low = middle - (*largest - *smallest) / 8;
  std::vector<double> passages;
  bool has_been_low = false;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i - 1] < low) has_been_low = true;
    if (!has_been_low || values[i - 1] >= middle || values[i] < middle) continue;
    passages.push_back(passage(time, values, i, middle));
    has_been_low = false;
  }
  return between(passages);
}

}  // namespace hemoscale::micro
