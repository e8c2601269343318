#include "micro/ensemble/flow/wall_geometry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

using Polyline = std::vector<Vector<2>>;

/// The channel 0 < y < 4, 0 < x < 10.
WallGeometry channel(double reach) {
  return WallGeometry({{{0, 0}, {10, 0}}, {{10, 4}, {0, 4}}}, reach);
}

void expect_at(const WallGeometry& walls, const Vector<2>& x, double distance,
               const Vector<2>& normal) {
  const WallDistance seen = walls.at(x);
  EXPECT_NEAR(seen.distance, distance, 1e-12) << x.transpose();
  EXPECT_NEAR((seen.normal - normal).norm(), 0, 1e-9)
      << x.transpose() << ": " << seen.normal.transpose();
}

TEST(WallGeometry, of_a_channel) {
  const WallGeometry walls = channel(3);
  expect_at(walls, {5, 1}, 1, {0, 1});
  expect_at(walls, {5, 3.5}, 0.5, {0, -1});
  expect_at(walls, {5, -0.25}, -0.25, {0, 1});
  expect_at(walls, {5, 4.125}, -0.125, {0, -1});
  expect_at(walls, {5, 0}, 0, {0, 1});
}

TEST(WallGeometry, beyond_its_reach_knows_at_least_the_side) {
  const WallGeometry walls = channel(0.5);
  EXPECT_GE(walls.at({5, 2}).distance, 0.5);
  EXPECT_LE(walls.at({5, -3}).distance, -0.5);
  EXPECT_LE(walls.at({5, 9}).distance, -0.5);
  EXPECT_LE(walls.at({5, -300}).distance, -0.5);
  EXPECT_EQ(walls.reach(), 0.5);
  EXPECT_EQ(walls.walls().size(), 2U);
}

TEST(WallGeometry, is_continued_beyond_open_ends) {
  const WallGeometry walls = channel(2);
  EXPECT_GT(walls.at({11, 1}).distance, 0);
  EXPECT_LT(walls.at({11, -1}).distance, 0);
  EXPECT_GT(walls.at({-1, 3}).distance, 0);
  EXPECT_LT(walls.at({-1, 5}).distance, 0);
}

/// A step: the fluid above the line (0,0) (5,0) (5,2) (10,2). At (5,0) the fluid has an angle of 90
/// degrees, at (5,2) one of 270.
TEST(WallGeometry, has_the_right_sign_at_both_kinds_of_corners) {
  const WallGeometry walls({{{0, 0}, {5, 0}, {5, 2}, {10, 2}}}, 4);
  const double r = std::sqrt(0.5);
  // around the corner that juts into the fluid
  expect_at(walls, {4, 3}, std::sqrt(2.0), {-r, r});
  expect_at(walls, {4, 2.5}, std::sqrt(1.25), Vector<2>(-1, 0.5).normalized());
  expect_at(walls, {4.5, 1}, 0.5, {-1, 0});
  expect_at(walls, {6, 2.5}, 0.5, {0, 1});
  expect_at(walls, {5.5, 1.75}, -0.25, {0, 1});
  expect_at(walls, {5.25, 1.5}, -0.25, {-1, 0});
  // around the corner that recedes from it
  expect_at(walls, {4.5, 0.25}, 0.25, {0, 1});
  expect_at(walls, {4.75, 0.5}, 0.25, {-1, 0});
  expect_at(walls, {6, -1}, -std::sqrt(2.0), {-r, r});
  expect_at(walls, {5.5, -1}, -std::sqrt(1.25), Vector<2>(-0.5, 1).normalized());
  // on the corners themselves
  expect_at(walls, {5, 0}, 0, {-r, r});
  expect_at(walls, {5, 2}, 0, {-r, r});
}

/// A divider of 10 degrees: the sign of either of its sides alone would be wrong before its tip.
TEST(WallGeometry, has_the_right_sign_before_a_sharp_tip) {
  const double rise = std::tan(5 * std::acos(-1) / 180);
  const WallGeometry walls({{{10, -10 * rise}, {0, 0}, {10, 10 * rise}}}, 20);
  // Travelling to the tip along the lower side, the fluid is below: on the left.
  for (double angle = 96; angle <= 264; angle += 7) {
    const double a = angle * std::acos(-1) / 180;
    EXPECT_NEAR(walls.at({std::cos(a), std::sin(a)}).distance, 1, 1e-12) << angle;
  }
  EXPECT_LT(walls.at({1, 0}).distance, 0);
  EXPECT_LT(walls.at({1e-3, 0}).distance, 0);
  EXPECT_GT(walls.at({1, 0.2}).distance, 0);
  EXPECT_GT(walls.at({1, -0.2}).distance, 0);
}

TEST(WallGeometry, of_a_closed_polyline) {
  const Polyline square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}};
  const WallGeometry inside({square}, 5);
  EXPECT_NEAR(inside.at({1, 0.5}).distance, 0.5, 1e-12);
  EXPECT_NEAR(inside.at({-1, -1}).distance, -std::sqrt(2.0), 1e-12);
  const WallGeometry around({Polyline(square.rbegin(), square.rend())}, 5);
  EXPECT_NEAR(around.at({1, 0.5}).distance, -0.5, 1e-12);
  EXPECT_NEAR(around.at({-1, -1}).distance, std::sqrt(2.0), 1e-12);
}

std::string refusal(const std::vector<Polyline>& walls, double reach = 1) {
  try {
    const WallGeometry geometry(walls, reach);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(WallGeometry, refuses_walls_that_are_none_and_says_where) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal({}), HasSubstr("there are none"));
  EXPECT_THAT(refusal({{{0, 0}}}), HasSubstr("at least two"));
  EXPECT_THAT(refusal({{{0, 0}, {3, 4}, {3, 4}}}),
              HasSubstr("coincide or are not finite, at (3, 4)"));
  EXPECT_THAT(refusal({{{0, 0}, {std::nan(""), 4}}}), HasSubstr("not finite"));
  EXPECT_THAT(refusal({{{0, 0}, {3, 4}, {0, 0}}}), HasSubstr("folds back"));
  EXPECT_THAT(refusal({{{0, 0}, {1, 0}}}, 0), HasSubstr("reach 0"));
}

TEST(WallGeometry, refuses_walls_that_cross_or_touch_and_says_where) {
  using testing::HasSubstr;
  const std::string crossing = refusal({{{0, 0}, {50, 0}, {100, 0}}, {{70, 5}, {72, -5}}});
  EXPECT_THAT(crossing, HasSubstr("segment 1 of wall 0"));
  EXPECT_THAT(crossing, HasSubstr("segment 0 of wall 1 (from (70, 5) m"));
  EXPECT_THAT(refusal({{{0, 0}, {4, 0}, {4, 4}, {2, -4}}}), HasSubstr("cross or touch"));
  EXPECT_THAT(refusal({{{0, 0}, {4, 0}}, {{2, 0}, {2, 3}}}), HasSubstr("cross or touch"));
  EXPECT_THAT(refusal({{{0, 0}, {4, 0}}, {{4, 0}, {8, 1}}}), HasSubstr("join walls that meet"));
  EXPECT_EQ(refusal({{{0, 0}, {4, 0}}, {{4, 0.001}, {8, 1}}}), "accepted");
}

}  // namespace
}  // namespace hemoscale::micro
