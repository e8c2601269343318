#include "micro/velocity_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

VelocityProfile sampled(int points, double height, double (*f)(double)) {
  VelocityProfile table;
  table.height = height;
  for (int i = 0; i < points; ++i) {
    table.velocities.push_back(f(height * i / (points - 1)));
  }
  return table;
}

double parabola(double y) {
  return 3 * y * (2 - y);
}
double cubic(double y) {
  return 1 + y * (2 + y * (-3 + 0.5 * y));
}

TEST(CubicProfile, is_exact_for_parabolas_and_cubics_also_beyond_the_walls) {
  for (const int points : {4, 5, 21}) {
    const CubicProfile u(sampled(points, 2, parabola));
    const CubicProfile v(sampled(points, 2, cubic));
    for (double y = -0.2; y <= 2.2; y += 0.01) {
      EXPECT_NEAR(u(y), parabola(y), 1e-12);
      EXPECT_NEAR(v(y), cubic(y), 1e-12);
    }
  }
}

TEST(CubicProfile, bounds_the_shear_rate) {
  const CubicProfile u(sampled(41, 2, parabola));
  EXPECT_GE(u.largest_shear_rate(), 6);
  EXPECT_LE(u.largest_shear_rate(), 6.4);
}

TEST(CubicProfile, converges_with_fourth_order) {
  double errors[2];
  int k = 0;
  for (const int points : {21, 41}) {
    const CubicProfile u(sampled(points, 2, [](double y) { return std::sin(3 * y); }));
    double worst = 0;
    for (double y = 0; y <= 2; y += 0.001) {
      worst = std::max(worst, std::abs(u(y) - std::sin(3 * y)));
    }
    errors[k++] = worst;
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 4, 0.3);
}

TEST(CubicProfile, refuses_broken_tables) {
  EXPECT_THROW(CubicProfile(sampled(3, 2, parabola)), ParameterError);
  EXPECT_THROW(CubicProfile(sampled(5, 0, parabola)), ParameterError);
  VelocityProfile table = sampled(5, 2, parabola);
  table.velocities[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(CubicProfile{table}, ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
