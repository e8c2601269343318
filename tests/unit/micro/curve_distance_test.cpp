#include "micro/cells/curve_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "micro/error.hpp"
#include "tests/support/micro/outlines.hpp"

namespace hemoscale::micro {
namespace {

const RingCurve circle(test::nodes_on({.a = 2, .b = 2, .centre = {10, 3}}, 100));

TEST(Gap, to_a_plate_is_that_of_the_lowest_point) {
  const test::Nodes plate = {{-100, 0}, {100, 0}};
  EXPECT_NEAR(gap(circle, plate), 1, 1e-5);
  const test::Nodes upper = {{100, 8}, {-100, 8}};
  EXPECT_NEAR(gap(circle, upper), 3, 1e-5);
}

TEST(Gap, to_the_corner_of_a_wall_and_past_its_end) {
  const test::Nodes step = {{0, 8}, {13, 8}, {13, 7}, {20, 7}};
  EXPECT_NEAR(gap(circle, step), 3, 1e-5);  // corner at (13, 7): distance 5 from the centre
  const test::Nodes short_wall = {{0, 0}, {6, 0}};
  EXPECT_NEAR(gap(circle, short_wall), 3, 1e-5);
}

TEST(Gap, is_zero_where_they_cross) {
  const test::Nodes plate = {{-100, 1.5}, {100, 1.5}};
  EXPECT_NEAR(gap(circle, plate), 0, 1e-5);
  EXPECT_NEAR(gap(circle, circle.moved({3.9, 0})), 0, 1e-5);
}

TEST(Gap, between_cells_outside_and_inside) {
  EXPECT_NEAR(gap(circle, circle.moved({4.5, 0})), 0.5, 1e-5);
  const RingCurve around(test::nodes_on({.a = 2.25, .b = 2.25, .centre = {10, 3}}, 100));
  EXPECT_NEAR(gap(circle, around), 0.25, 1e-5);
}

TEST(DistanceTo, is_that_of_the_nearest_point) {
  EXPECT_NEAR(distance_to(circle, {10, 3}), 2, 1e-5);
  EXPECT_NEAR(distance_to(circle, {13, 7}), 3, 1e-5);
}

TEST(LargestDistance, of_a_curve_from_itself_is_zero_whatever_its_nodes) {
  const RingCurve once(test::crescent(0.5, -0.6, 200, 0.0));
  const RingCurve again(test::crescent(0.5, -0.6, 163, 1.0));
  EXPECT_LT(largest_distance(once, again, Alignment::none), 1e-5);
}

TEST(LargestDistance, sees_what_is_not_aligned) {
  const RingCurve moved = circle.moved({7, 0.5});
  EXPECT_NEAR(largest_distance(circle, moved, Alignment::none), std::hypot(7, 0.5), 1e-3);
  EXPECT_NEAR(largest_distance(circle, moved, Alignment::along_flow), 0.5, 1e-3);
  EXPECT_NEAR(largest_distance(circle, moved, Alignment::both), 0, 1e-5);
}

TEST(LargestDistance, looks_in_both_directions) {
  // The ends of the ellipse are 1.5 outside the circle; the circle is nowhere that far from the
  // ellipse.
  const RingCurve unit(test::nodes_on({.a = 2, .b = 2}, 200));
  const RingCurve longer(test::nodes_on({.a = 3.5, .b = 2, .start = 0}, 200));
  EXPECT_NEAR(largest_distance(unit, longer, Alignment::none), 1.5, 1e-4);
  EXPECT_NEAR(largest_distance(longer, unit, Alignment::none), 1.5, 1e-4);
}

TEST(Asymmetry, is_zero_for_a_crescent_anywhere_and_grows_with_its_tilt) {
  test::Nodes nodes = test::crescent(0.5, -0.6, 100);
  EXPECT_LT(asymmetry(RingCurve(nodes).moved({5, 7})), 1e-5);
  for (Vector<2>& node : nodes) node = test::turned(node, 0.1);
  EXPECT_GT(asymmetry(RingCurve(nodes)), 0.05);
}

TEST(Asymmetry, of_an_inclined_ellipse_is_known_at_its_ends) {
  // Close to the circle, r = 1 + e cos(2 (p - q)): the image has -q, and they differ by 2 e sin 2q
  // sin 2p at most.
  const double e = 1e-3;
  const RingCurve curve(test::nodes_on({.a = 1 + e, .b = 1 - e, .angle = 0.5}, 200));
  EXPECT_NEAR(asymmetry(curve), 2 * e * std::sin(1.0), 0.02 * e);
}

TEST(Gap, refuses_a_wall_of_one_point) {
  EXPECT_THROW(gap(circle, std::vector<Vector<2>>{{0, 0}}), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
