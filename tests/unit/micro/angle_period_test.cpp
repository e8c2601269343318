#include "micro/cells/angle_period.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "micro/error.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::micro {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<double> times(double end, double step) {
  std::vector<double> result;
  for (int i = 0; i * step <= end; ++i) result.push_back(i * step);
  return result;
}

std::vector<double> values_at(const std::vector<double>& time,
                              const std::function<double(double)>& f) {
  std::vector<double> result;
  for (const double t : time) result.push_back(f(t));
  return result;
}

// Orbit of Jeffery in the plane: tan(angle) = -cot(G t / (r + 1/r)) / r, of period 2 pi (r + 1/r) /
// G for the full turn; the long axis is seen in (-pi/2, pi/2].
TEST(TurningPeriod, of_a_rigid_ellipse_in_shear) {
  const double ratio = 3;
  const double rate = 2 / (ratio + 1 / ratio);
  const std::vector<double> time = times(50, 0.05);
  const std::vector<double> angles = values_at(
      time, [&](double t) { return std::atan(1 / (ratio * std::tan(rate * (t + 0.013)))); });
  const auto period = turning_period(time, unwrapped(angles, pi), pi / 2);
  ASSERT_TRUE(period.has_value());
  EXPECT_NEAR(period->mean, 2 * pi / rate, 1e-3);
  EXPECT_EQ(period->count, 3);
  EXPECT_LT(period->scatter, 1e-3);
}

TEST(TurningPeriod, of_either_sense_and_through_noise) {
  const std::vector<double> time = times(40, 0.02);
  for (const double sense : {1.0, -1.0}) {
    std::uint64_t i = 0;
    const std::vector<double> angles = values_at(time, [&](double t) {
      return sense * 2 * pi * t / 7 + 0.1 * normal({3, 4, i++});
    });
    const auto period = turning_period(time, angles, 1);
    ASSERT_TRUE(period.has_value());
    // Passages at 1.1 + 7 k up to 40, or at -1.1 + 7 k.
    EXPECT_EQ(period->count, sense > 0 ? 5 : 4);
    EXPECT_NEAR(period->mean, 7, 0.1);
    EXPECT_GT(period->scatter, 0);
    EXPECT_LT(period->scatter, 0.2);
  }
}

TEST(TurningPeriod, has_the_scatter_of_unequal_turns) {
  const std::vector<double> time = {0, 1, 3, 4};
  const std::vector<double> angles = {-0.5 * pi, 1.5 * pi, 3.5 * pi, 5.5 * pi};
  const auto period = turning_period(time, angles, 0);
  ASSERT_TRUE(period.has_value());
  // Passages at 0.25, 1.5 and 3.25.
  EXPECT_NEAR(period->mean, 1.5, 1e-12);
  EXPECT_NEAR(period->scatter, std::sqrt(2 * 0.25 * 0.25), 1e-12);
}

TEST(TurningPeriod, takes_the_middle_of_several_passages) {
  const std::vector<double> time = {0, 1, 2, 3, 4};
  const std::vector<double> turns = {-0.5, 0.5, -0.5, 0.5, 1.5};
  std::vector<double> angles;
  for (const double turn : turns) angles.push_back(2 * pi * turn);
  const auto period = turning_period(time, angles, 0);
  ASSERT_TRUE(period.has_value());
  // Of the level 0 at 0.5, 1.5 and 2.5; of the level 1 at 3.5.
  EXPECT_NEAR(period->mean, 2, 1e-12);
}

TEST(TurningPeriod, needs_a_whole_turn) {
  const std::vector<double> time = times(10, 0.1);
  EXPECT_FALSE(turning_period(time, values_at(time, [](double t) { return 0.6 * t; }), 1));
  EXPECT_FALSE(turning_period(time, values_at(time, [](double t) { return std::sin(t); }), 0));
  EXPECT_TRUE(turning_period(time, values_at(time, [](double t) { return 0.8 * t; }), 1));
  EXPECT_FALSE(turning_period({}, {}, 0));
}

TEST(Unwrapped, follows_the_motion_and_refuses_what_is_too_fast) {
  const std::vector<double> angles = {1.4, -1.5, -1.2, 1.5};
  const std::vector<double> smooth = unwrapped(angles, pi);
  EXPECT_NEAR(smooth[1], pi - 1.5, 1e-12);
  EXPECT_NEAR(smooth[2], pi - 1.2, 1e-12);
  EXPECT_NEAR(smooth[3], 1.5, 1e-12);
  const std::vector<double> fast = {0, 1.2, 2.4};
  EXPECT_THROW(unwrapped(fast, pi), ParameterError);
  EXPECT_NO_THROW(unwrapped(fast, 2 * pi));
}

TEST(OscillationPeriod, of_a_swing_is_found_through_noise) {
  const std::vector<double> time = times(50, 0.05);
  std::uint64_t i = 0;
  const auto period = oscillation_period(
      time, values_at(time, [&](double t) {
        return 0.3 + 0.2 * std::sin(2 * pi * t / 9) + 0.005 * normal({3, 4, i++});
      }));
  ASSERT_TRUE(period.has_value());
  EXPECT_EQ(period->count, 4);
  EXPECT_NEAR(period->mean, 9, 0.1);
}

TEST(OscillationPeriod, needs_a_whole_period) {
  const std::vector<double> time = times(10, 0.1);
  EXPECT_FALSE(oscillation_period(time, values_at(time, [](double t) { return t; })));
  EXPECT_FALSE(oscillation_period(time, values_at(time, [](double) { return 1.0; })));
  EXPECT_FALSE(oscillation_period({}, {}));
}

TEST(Periods, refuse_series_of_different_length) {
  const std::vector<double> two = {0, 1};
  const std::vector<double> one = {0};
  EXPECT_THROW(turning_period(two, one, 0), ParameterError);
  EXPECT_THROW(oscillation_period(two, one), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
