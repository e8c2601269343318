#include "micro/ensemble/flow/parallel_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "micro/ensemble/flow/expansion_error.hpp"
#include "micro/error.hpp"
#include "micro/velocity_profile.hpp"

namespace hemoscale::micro {
namespace {

constexpr double height = 75e-6;  // [m]
constexpr double top = 3e-3;      // [m/s] on the axis

VelocityProfile sampled(int points, double (*f)(double)) {
  VelocityProfile table;
  table.height = height;
  for (int i = 0; i < points; ++i) {
    table.velocities.push_back(top * f(static_cast<double>(i) / (points - 1)));
  }
  return table;
}

double parabola(double s) {
  return 4 * s * (1 - s);
}
double cubic(double s) {
  return s * (1 - s) * (1 + 2 * s);
}
double wave(double s) {
  return std::sin(5 * s);
}

TEST(ParallelFlow, is_exact_for_a_parabola_up_to_its_second_derivative_also_beyond_the_walls) {
  for (const int points : {4, 17, 100}) {
    const ParallelFlow flow(sampled(points, parabola));
    for (double s = -0.1; s <= 1.1; s += 0.013) {
      const LocalFlow here = flow.at({1e-4, s * height}, 7);
      const bool is_inside = s >= 0 && s <= 1;  // rounding grows with the distance from the walls
      EXPECT_NEAR(here.velocity[0], top * parabola(s), (is_inside ? 1e-14 : 1e-10) * top);
      EXPECT_NEAR(here.gradient(0, 1), top * 4 * (1 - 2 * s) / height, 1e-11 * top / height);
      EXPECT_NEAR(here.second[0](1, 1) * height * height / top, -8, 1e-8);
      EXPECT_EQ(here.velocity[1], 0);
      EXPECT_EQ(here.gradient(0, 0), 0);
      EXPECT_EQ(here.gradient(1, 0), 0);
      EXPECT_EQ(here.second[0](0, 1), 0);
      EXPECT_EQ(here.second[1].norm(), 0);
    }
  }
}

TEST(ParallelFlow, has_the_velocity_of_the_reference_ensemble) {
  const VelocityProfile table = sampled(23, wave);
  const ParallelFlow flow(table);
  const CubicProfile reference(table);
  for (double s = -0.2; s <= 1.2; s += 0.0037) {
    const double tolerance = s >= 0 && s <= 1 ? 1e-14 : 1e-11;
    EXPECT_NEAR(flow.at({0, s * height}, 0).velocity[0], reference(s * height), tolerance * top);
  }
  EXPECT_EQ(flow.largest_shear_rate(), reference.largest_shear_rate());
}

TEST(ParallelFlow, derivatives_are_those_of_its_velocity) {
  const ParallelFlow flow(sampled(9, cubic));
  const double d = 1e-4 * height;
  for (double s = 0.01; s < 1; s += 0.031) {
    const Vector<2> x(0, s * height);
    const double above = flow.at(x + Vector<2>(0, d), 0).velocity[0];
    const double below = flow.at(x - Vector<2>(0, d), 0).velocity[0];
    const LocalFlow here = flow.at(x, 0);
    EXPECT_NEAR(here.gradient(0, 1), (above - below) / (2 * d), 1e-6 * top / height);
    EXPECT_NEAR(here.second[0](1, 1), (above - 2 * here.velocity[0] + below) / (d * d),
                1e-5 * top / (height * height));
  }
}

TEST(ParallelFlow, bounds_the_speed_tightly) {
  const ParallelFlow flow(sampled(33, parabola));
  EXPECT_GE(flow.largest_speed(), top * (1 - 1e-12));
  EXPECT_LE(flow.largest_speed(), top * 1.01);
  EXPECT_TRUE(flow.is_steady());
}

TEST(ParallelFlow, refuses_broken_tables) {
  EXPECT_THROW(ParallelFlow(sampled(3, parabola)), ParameterError);
  VelocityProfile table = sampled(5, parabola);
  table.velocities[1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(ParallelFlow{table}, ParameterError);
}

TEST(SimpleShearFlow, is_linear) {
  const SimpleShearFlow flow(-200, 50e-6);
  const LocalFlow here = flow.at({3e-6, 20e-6}, 0);
  EXPECT_DOUBLE_EQ(here.velocity[0], -4e-3);
  EXPECT_EQ(here.velocity[1], 0);
  EXPECT_EQ(here.gradient(0, 1), -200);
  EXPECT_EQ(here.gradient.norm(), 200);
  EXPECT_EQ(flow.largest_shear_rate(), 200);
  EXPECT_DOUBLE_EQ(flow.largest_speed(), 1e-2);
  EXPECT_THROW(SimpleShearFlow(std::nan(""), 1), ParameterError);
  EXPECT_THROW(SimpleShearFlow(1, 0), ParameterError);
}

/// Of u = c s^3 the expansion leaves out c (d / height)^3.
TEST(ExpansionError, is_what_the_second_order_leaves_out) {
  const ParallelFlow flow(sampled(40, [](double s) { return s * s * s; }));
  const double radius = 4e-6;
  const double error = expansion_error(flow, 0, radius, {{0, 0.3 * height}, {0, 0.6 * height}});
  EXPECT_NEAR(error, top * std::pow(radius / height, 3), 1e-9 * top);
  const ParallelFlow exact(sampled(40, parabola));
  EXPECT_LE(expansion_error(exact, 0, radius, {{0, 0.4 * height}}), 1e-11 * top);
  EXPECT_THROW(expansion_error(exact, 0, 0, {{0, 0}}), ParameterError);
  EXPECT_THROW(expansion_error(exact, 0, radius, {}), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
