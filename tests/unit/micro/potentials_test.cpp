#include <gtest/gtest.h>

#include <cmath>

#include "micro/ensemble/pair_potential.hpp"
#include "micro/ensemble/wall_potential.hpp"

namespace hemoscale::micro {
namespace {

constexpr double r0 = 0.5e-6;
constexpr double rc = 0.8e-6;
const PairPotential potential = make_pair_potential(10, r0, rc, 0.05);

double force(double r) {
  return potential.force_over_distance(r * r) * r;
}
double energy(double r) {
  return potential.energy(r * r);
}

TEST(PairPotential, force_is_minus_gradient_of_energy) {
  const double scale = force(0.25e-6);
  const double h = 1e-5 * r0;
  for (double r = 0.0113e-6; r < 0.85e-6; r += 0.007e-6) {  // misses the kink at r0
    EXPECT_NEAR(force(r), -(energy(r + h) - energy(r - h)) / (2 * h), 1e-8 * scale) << r;
  }
}

TEST(PairPotential, curvature_is_minus_slope_of_force) {
  const double h = 1e-6 * r0;
  for (double r = 0.013e-6; r < 0.85e-6; r += 0.007e-6) {
    EXPECT_NEAR(potential.curvature(r * r), -(force(r + h) - force(r - h)) / (2 * h), 1e-5 * 10)
        << r;
  }
}

TEST(PairPotential, has_the_wanted_stiffness_at_the_rest_distance) {
  const double inside = r0 * (1 - 1e-9);
  EXPECT_NEAR(potential.curvature(inside * inside), 10, 1e-6);
  EXPECT_EQ(potential.force_over_distance(potential.rest_squared), 0);
}

TEST(PairPotential, repels_inside_attracts_outside_and_ends_smoothly) {
  EXPECT_GT(force(0.9 * r0), 0);
  EXPECT_LT(force(1.1 * r0), 0);
  EXPECT_EQ(force(rc), 0);
  EXPECT_EQ(force(1.0001 * rc), 0);
  EXPECT_EQ(energy(rc), 0);
  EXPECT_LT(std::abs(force(0.9999 * rc)), 1e-6 * force(0.25e-6));
  EXPECT_NEAR(energy(r0 * (1 - 1e-9)), energy(r0 * (1 + 1e-9)), 1e-12 * std::abs(energy(0.3e-6)));
}

TEST(PairPotential, without_attraction_only_repels) {
  const PairPotential repulsion = make_pair_potential(10, r0, rc, 0);
  EXPECT_EQ(repulsion.force_over_distance(1.2 * r0 * r0), 0);
  EXPECT_EQ(repulsion.energy(1.2 * r0 * r0), 0);
  EXPECT_GT(repulsion.energy(0.8 * r0 * r0), 0);
}

TEST(WallPotential, pushes_within_its_range_and_beyond_the_wall) {
  const WallPotential wall{.stiffness = 10, .range = 0.5e-6};
  EXPECT_EQ(wall.force(0.5e-6), 0);
  EXPECT_DOUBLE_EQ(wall.force(0), 10 * 0.5e-6);
  EXPECT_GT(wall.force(-1e-6), wall.force(0));
  const double h = 1e-11;
  for (double d = -0.4e-6; d < 0.7e-6; d += 0.03e-6) {
    EXPECT_NEAR(wall.force(d), -(wall.energy(d + h) - wall.energy(d - h)) / (2 * h), 1e-10);
  }
}

}  // namespace
}  // namespace hemoscale::micro
