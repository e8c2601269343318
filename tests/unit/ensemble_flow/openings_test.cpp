#include "micro/ensemble/flow/openings.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "micro/ensemble/flow/parallel_flow.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

constexpr double height = 75e-6;        // [m]
constexpr double mean_velocity = 2e-3;  // [m/s]

ParallelFlow poiseuille() {
  VelocityProfile table;
  table.height = height;
  for (int k = 0; k <= 16; ++k) {
    const double s = k / 16.0;
    table.velocities.push_back(6 * mean_velocity * s * (1 - s));
  }
  return ParallelFlow(table);
}

/// Fluid on the left: the inlet of a channel along x is travelled downwards.
const Opening inlet{"inlet", {0, height}, {0, 0}};
const Opening outlet{"outlet", {2e-4, 0}, {2e-4, height}};

TEST(Opening, has_the_fluid_on_its_left) {
  EXPECT_NEAR((inlet.inward() - Vector<2>(1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((outlet.inward() - Vector<2>(-1, 0)).norm(), 0, 1e-15);
  EXPECT_DOUBLE_EQ(inlet.length(), height);
  EXPECT_NEAR(depth(inlet, {3e-6, 1e-6}), 3e-6, 1e-18);
  EXPECT_NEAR(depth(outlet, {2.1e-4, 1e-6}), -1e-5, 1e-17);
  EXPECT_NEAR((point_at(inlet, 1e-5, 2e-6) - Vector<2>(2e-6, height - 1e-5)).norm(), 0, 1e-18);
}

TEST(Opening, flux_of_a_parabola_is_exact) {
  const ParallelFlow flow = poiseuille();
  EXPECT_NEAR(volume_flux(inlet, flow, 0), mean_velocity * height, 1e-12 * mean_velocity * height);
  EXPECT_NEAR(volume_flux(outlet, flow, 0), -mean_velocity * height,
              1e-12 * mean_velocity * height);
  EXPECT_NEAR(inflow_flux(inlet, flow, 0), mean_velocity * height, 1e-12 * mean_velocity * height);
  EXPECT_EQ(inflow_flux(outlet, flow, 0), 0);
  // Also through a slanting section.
  const Opening slanting{"slanting", {0, height}, {4e-5, 0}};
  EXPECT_NEAR(volume_flux(slanting, flow, 0), mean_velocity * height,
              1e-12 * mean_velocity * height);
}

TEST(Opening, of_a_flow_in_both_directions) {
  const SimpleShearFlow flow(100, height);
  const Opening both{"both", {0, height}, {0, -height}};
  EXPECT_NEAR(volume_flux(both, flow, 0), 0, 1e-18);
  EXPECT_NEAR(inflow_flux(both, flow, 0), 50 * height * height, 1e-9 * height * height);
}

TEST(Opening, is_left_between_the_continued_walls_and_within_the_overhang) {
  const double overhang = 1e-5;
  EXPECT_FALSE(has_left(outlet, {1.99e-4, 3e-5}, overhang));
  EXPECT_TRUE(has_left(outlet, {2.01e-4, 3e-5}, overhang));
  EXPECT_FALSE(has_left(outlet, {2.2e-4, 3e-5}, overhang));
  EXPECT_FALSE(has_left(outlet, {2.01e-4, -1e-6}, overhang));
  EXPECT_FALSE(has_left(outlet, {2.01e-4, height + 1e-6}, overhang));
  EXPECT_TRUE(has_left(inlet, {-1e-6, 3e-5}, overhang));
}

TEST(Opening, without_length_is_refused) {
  EXPECT_NO_THROW(check(inlet));
  EXPECT_THROW(check(Opening{"a", {1, 1}, {1, 1}}), ParameterError);
  EXPECT_THROW(check(Opening{"a", {1, 1}, {std::nan(""), 1}}), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
