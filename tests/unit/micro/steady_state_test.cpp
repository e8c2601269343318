#include "micro/cells/steady_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "micro/error.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::micro {
namespace {

// Samples of v(t) every 0.1 up to `end`; the progress is twice the time.
SteadyState look(const std::function<double(double)>& v, double end, double window = 10) {
  std::vector<double> time, progress, values;
  for (int i = 0; 0.1 * i <= end; ++i) {
    time.push_back(0.1 * i);
    progress.push_back(0.2 * i);
    values.push_back(v(0.1 * i));
  }
  return find_steady_state(time, progress, values, {.tolerance = 0.005, .window = window});
}

double noise(double t, std::uint64_t seed) {
  return normal({seed, 1, static_cast<std::uint64_t>(std::lround(10 * t))});
}

TEST(SteadyState, of_a_constant_is_there_from_the_start) {
  const SteadyState state = look([](double) { return 3.0; }, 20);
  EXPECT_EQ(state.steadiness, Steadiness::settled);
  EXPECT_NEAR(state.final_value, 3, 1e-12);
  EXPECT_EQ(state.settling_time.value(), 0);
}

TEST(SteadyState, of_an_exponential_approach_is_extrapolated) {
  // 0.005 of 2 is reached at exp(-t/4) = 0.01 / 0.7.
  const auto v = [](double t) { return 2 - 0.7 * std::exp(-t / 4); };
  const SteadyState state = look(v, 25);
  EXPECT_EQ(state.steadiness, Steadiness::settled);
  EXPECT_NEAR(state.final_value, 2, 1e-6);
  EXPECT_NEAR(state.settling_time.value(), 4 * std::log(70), 0.01);
  EXPECT_NEAR(state.remaining, 0.35 * std::exp(-25.0 / 4), 1e-6);
}

TEST(SteadyState, settles_from_either_side_and_across) {
  const auto v = [](double t) { return 1 + 0.5 * std::exp(-t / 2) * std::cos(t); };
  const SteadyState state = look(v, 40);
  ASSERT_EQ(state.steadiness, Steadiness::settled);
  const double time = state.settling_time.value();
  EXPECT_NEAR(std::abs(v(time) - 1), 0.005, 2e-4);
  for (double t = time + 0.05; t < 40; t += 0.01) ASSERT_LE(std::abs(v(t) - 1), 0.005);
}

// Changes by 0.8 of the tolerance over the last window, but 3 % are still to come.
TEST(SteadyState, does_not_take_a_slow_approach_for_its_end) {
  const auto v = [](double t) { return 1 - 0.05 * std::exp(-t / 60); };
  const SteadyState state = look(v, 30);
  EXPECT_EQ(state.steadiness, Steadiness::approaching);
  EXPECT_LT(state.change, 0.005);
  EXPECT_NEAR(state.final_value, 1, 1e-4);
  EXPECT_NEAR(state.remaining, 0.05 * std::exp(-0.5), 1e-4);
  EXPECT_FALSE(state.settling_time.has_value());
}

TEST(SteadyState, is_not_reached_by_drift_growth_or_oscillation) {
  EXPECT_EQ(look([](double t) { return 1 + 0.01 * t; }, 40).steadiness, Steadiness::changing);
  EXPECT_EQ(look([](double t) { return 1 + 0.001 * std::exp(t / 5); }, 40).steadiness,
            Steadiness::changing);
  EXPECT_EQ(look([](double t) { return 1 + 0.02 * std::sin(3 * t); }, 40).steadiness,
            Steadiness::changing);
  // Slower: within the tolerance over a window, but not over the twenty to come.
  EXPECT_EQ(look([](double t) { return 1 + 0.0004 * t; }, 40).steadiness, Steadiness::approaching);
  EXPECT_EQ(look([](double t) { return 1 + 1e-6 * std::exp(t / 5); }, 36).steadiness,
            Steadiness::approaching);
}

TEST(SteadyState, may_drift_by_what_does_not_matter) {
  EXPECT_EQ(look([](double t) { return 1 + 1e-6 * t; }, 40).steadiness, Steadiness::settled);
}

TEST(SteadyState, is_seen_through_noise_within_the_tolerance) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto v = [seed](double t) { return 2 - 0.7 * std::exp(-t / 4) + 0.002 * noise(t, seed); };
    const SteadyState state = look(v, 60);
    EXPECT_EQ(state.steadiness, Steadiness::settled) << seed;
    EXPECT_NEAR(state.final_value, 2, 0.002) << seed;
  }
  EXPECT_EQ(look([](double t) { return 1 + 0.01 * noise(t, 1); }, 60).steadiness,
            Steadiness::changing);
}

TEST(SteadyState, has_an_oscillation_within_the_tolerance) {
  const SteadyState state = look([](double t) { return 1 + 0.002 * std::sin(3 * t); }, 40);
  EXPECT_EQ(state.steadiness, Steadiness::settled);
  EXPECT_NEAR(state.final_value, 1, 1e-3);
}

TEST(SteadyState, needs_two_windows_and_eight_samples) {
  const auto v = [](double) { return 1.0; };
  EXPECT_EQ(look(v, 9).steadiness, Steadiness::too_short);
  EXPECT_EQ(look(v, 11).steadiness, Steadiness::settled);
  EXPECT_EQ(look(v, 11, 1).steadiness, Steadiness::too_short);
  EXPECT_EQ(look(v, 11, 2).steadiness, Steadiness::settled);
  EXPECT_EQ(find_steady_state({}, {}, {}, {.window = 1}).steadiness, Steadiness::too_short);
}

TEST(SteadyState, refuses_what_is_no_series) {
  const std::vector<double> time = {0, 1, 2};
  const std::vector<double> two = {0, 1};
  const std::vector<double> back = {0, 2, 1};
  const std::vector<double> broken = {0, std::numeric_limits<double>::infinity(), 2};
  EXPECT_NO_THROW(find_steady_state(time, time, time, {.window = 1}));
  EXPECT_THROW(find_steady_state(time, time, two, {.window = 1}), ParameterError);
  EXPECT_THROW(find_steady_state(time, two, time, {.window = 1}), ParameterError);
  EXPECT_THROW(find_steady_state(back, time, time, {.window = 1}), ParameterError);
  EXPECT_THROW(find_steady_state(time, back, time, {.window = 1}), ParameterError);
  EXPECT_THROW(find_steady_state(time, time, broken, {.window = 1}), ParameterError);
  EXPECT_THROW(find_steady_state(time, time, time, {}), ParameterError);
  EXPECT_THROW(find_steady_state(time, time, time, {.tolerance = 0, .window = 1}), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
