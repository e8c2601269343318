#include "micro/cells/ring_concavity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "micro/cells/outline.hpp"
#include "micro/cells/ring_shape.hpp"
#include "tests/support/micro/outlines.hpp"

namespace hemoscale::micro {
namespace {

const Vector<2> rear(-1, 0);
const Vector<2> front(1, 0);

TEST(Concavity, a_convex_cell_has_none) {
  const RingCurve curve(test::nodes_on({.a = 3, .b = 1, .angle = 0.7}, 59));
  const std::vector<Concavity> found = concavities(curve);
  EXPECT_TRUE(found.empty());
  EXPECT_EQ(dimple_depth(found, rear), 0);
  EXPECT_EQ(convexity(measure_shape(curve).area, found), 1);
}

// x = thickness cos p + bend sin^2 p, y = sin p. Its left-most points are at cos p = thickness / (2
// bend), at x = bend + thickness^2 / (4 bend); on the axis the rear is at -thickness.
TEST(Concavity, of_a_crescent_is_at_the_rear) {
  const double thickness = 0.5;
  const double bend = -0.8;
  const RingCurve curve(test::crescent(thickness, bend, 400));
  const std::vector<Concavity> found = concavities(curve);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(dimple_depth(found, rear), -thickness - (bend + thickness * thickness / (4 * bend)),
              1e-8);
  EXPECT_EQ(dimple_depth(found, front), 0);
  EXPECT_LT((found[0].deepest - Vector<2>(-thickness, 0)).norm(), 1e-3);
  EXPECT_LT((found[0].outward - rear).norm(), 1e-6);
  EXPECT_NEAR(found[0].first.x(), found[0].second.x(), 1e-8);
}

// The section of the red cell has two equal dimples; lying across the flow, front and rear.
TEST(Concavity, of_the_resting_cell_is_on_both_sides) {
  test::Nodes nodes = outline_nodes({}, 400);
  const std::vector<Concavity> along = concavities(RingCurve(nodes));
  EXPECT_EQ(along.size(), 2U);
  EXPECT_EQ(dimple_depth(along, rear), 0);
  EXPECT_EQ(dimple_depth(along, front), 0);
  for (Vector<2>& node : nodes) node = test::turned(node, std::numbers::pi / 2);
  const std::vector<Concavity> across = concavities(RingCurve(nodes));
  // Largest and smallest thickness are 2.57 and 0.81 um [Evans and Fung 1972].
  EXPECT_NEAR(dimple_depth(across, rear), 0.88e-6, 0.01e-6);
  EXPECT_NEAR(dimple_depth(across, front), dimple_depth(across, rear), 1e-12);
}

TEST(Concavity, of_a_tilted_cell_is_measured_along_the_flow) {
  test::Nodes nodes = test::crescent(0.5, -0.8, 400);
  const double upright = dimple_depth(concavities(RingCurve(nodes)), rear);
  for (Vector<2>& node : nodes) node = test::turned(node, 0.3);
  EXPECT_NEAR(dimple_depth(concavities(RingCurve(nodes)), rear), upright / std::cos(0.3), 1e-6);
}

TEST(Convexity, counts_the_area_of_the_concavities) {
  const RingCurve curve(test::crescent(0.5, -0.8, 400));
  const std::vector<Concavity> found = concavities(curve);
  ASSERT_EQ(found.size(), 1U);
  // Between the rear, x = bend + thickness c - bend c^2 with c = cos p from -1 to ..., and the
  // chord at x0 its turning point: integral of (x - x0) dy by the midpoint rule.
  const double x0 = -0.8 - 0.25 / 3.2;
  double area = 0;
  const double end = std::acos(-0.25 / 0.8);
  const int steps = 20000;
  for (int k = 0; k < steps; ++k) {
    const double p = end + (2 * (std::numbers::pi - end)) * (k + 0.5) / steps;
    const double x = 0.5 * std::cos(p) - 0.8 * std::pow(std::sin(p), 2);
    area += (x - x0) * -std::cos(p) * 2 * (std::numbers::pi - end) / steps;
  }
  EXPECT_NEAR(found[0].area, area, 1e-6);
  EXPECT_NEAR(convexity(2, found), 2 / (2 + area), 1e-6);
}

}  // namespace
}  // namespace hemoscale::micro
