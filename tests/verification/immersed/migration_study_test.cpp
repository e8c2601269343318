#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/support/immersed/implicit_runs.hpp"

// A cell off the axis of a channel goes to it. References: converged spectral solutions made for
// this project.
namespace hemoscale::micro {
namespace {

using namespace test;

constexpr double speed = 1e-3;
constexpr double perimeter = 17.59 * micron;
constexpr double base_radius = perimeter / (2 * std::numbers::pi);

/// At a bending capillary number mu (U/H) R0^3 / kappa of 10.
ImplicitMembranes released(double height, double spacing, double off) {
  const CellPlan plan{
      .bending_modulus = water.viscosity() * speed / height * std::pow(base_radius, 3) / 10,
      .perimeter = perimeter,
      .centre = {20 * micron, height / 2 + off}};
  return {kept_channel(40 * micron, height, spacing, speed),
          {deflated_cell(plan)},
          {.longest_step = 2 * spacing / speed}};
}

// v = -xi g R0^2 / (H/2 - |y|) with g the shear rate at y, xi = 0.153 for y from 1.2 to 4.8 um.
TEST(Migration, follows_the_known_law) {
  const double height = 20 * micron;
  ImplicitMembranes membranes = released(height, 1 * micron, 5 * micron);
  double sum = 0;
  int count = 0;
  double y = look_at(membranes).shape.centroid.y() - height / 2;
  for (int k = 0; k < 36; ++k) {
    membranes.advance_by(0.01);
    const double next = look_at(membranes).shape.centroid.y() - height / 2;
    const double middle = (y + next) / 2;
    const double drift = (next - y) / 0.01;
    y = next;
    if (middle > 4.5 * micron || middle < 1.5 * micron || membranes.time() < 0.03) continue;
    const double shear_rate = 12 * speed * middle / (height * height);
    const double xi = -drift * (height / 2 - middle) / (shear_rate * base_radius * base_radius);
    std::printf("y %.2f um: xi %.4f\n", middle * 1e6, xi);
    sum += xi;
    ++count;
  }
  ASSERT_GT(count, 10);
  EXPECT_NEAR(sum / count, 0.153, 0.1 * 0.153);
  // 360 um on the way: at 0.92 um.
  EXPECT_NEAR(y, 0.93 * micron, 0.1 * micron);
}

TEST(Migration, passes_a_fast_slipper_and_ends_in_the_middle) {
  const double height = 10 * micron;
  ImplicitMembranes membranes = released(height, 0.5 * micron, 0.8 * micron);
  membranes.advance_by(0.038);
  const double drop_unit = water.viscosity() * speed / height;
  EXPECT_NEAR(look_at(membranes).motion.velocity.x() / speed, 1.366, 0.005);
  EXPECT_NEAR(MembraneFlow(membranes).extra_pressure_drop() / drop_unit, 0.63, 0.03);
  membranes.advance_by(0.162);
  EXPECT_NEAR(look_at(membranes).motion.velocity.x() / speed, 1.319, 0.001);
  EXPECT_NEAR(MembraneFlow(membranes).extra_pressure_drop() / drop_unit, 1.141, 0.01);
  EXPECT_NEAR(look_at(membranes).shape.centroid.y(), height / 2, 0.01 * micron);
}

}  // namespace
}  // namespace hemoscale::micro
