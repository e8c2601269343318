#include "micro/cells/ring_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "micro/error.hpp"
#include "tests/support/micro/outlines.hpp"

namespace hemoscale::micro {
namespace {

constexpr double pi = std::numbers::pi;

TEST(RingShape, of_an_ellipse_is_that_of_the_textbook) {
  const double angle = 0.4;
  const RingShape shape = measure_shape(
      RingCurve(test::nodes_on({.a = 3, .b = 1, .angle = angle, .centre = {5, -2}}, 400)));
  EXPECT_NEAR(shape.area, 3 * pi, 1e-7);
  EXPECT_NEAR(shape.perimeter, 13.364893220555258, 1e-7);  // 12 E(sqrt(8/9))
  EXPECT_NEAR(shape.reduced_area, 4 * pi * shape.area / std::pow(shape.perimeter, 2), 1e-14);
  EXPECT_LT((shape.centroid - Vector<2>(5, -2)).norm(), 1e-9);
  EXPECT_NEAR(shape.length, 2 * std::hypot(3 * std::cos(angle), std::sin(angle)), 1e-7);
  EXPECT_NEAR(shape.width, 2 * std::hypot(3 * std::sin(angle), std::cos(angle)), 1e-7);
  EXPECT_NEAR(shape.upper.x() - shape.lower.x(), shape.length, 1e-12);
  EXPECT_NEAR((shape.upper.y() + shape.lower.y()) / 2, -2, 1e-7);
  EXPECT_NEAR(shape.inclination, angle, 1e-8);
  EXPECT_NEAR(shape.deformation, 0.5, 1e-8);
  EXPECT_NEAR(shape.axial_length, 6, 1e-7);
  EXPECT_NEAR(shape.axial_width, 2, 1e-7);
}

TEST(RingShape, has_the_moments_of_an_ellipse) {
  const RingCurve curve(test::nodes_on({.a = 3, .b = 1}, 400));
  const Tensor<2> moments = area_moments(curve, Vector<2>::Zero());
  EXPECT_NEAR(moments(0, 0), pi * 27 / 4, 1e-6);
  EXPECT_NEAR(moments(1, 1), pi * 3 / 4, 1e-6);
  EXPECT_NEAR(moments(0, 1), 0, 1e-6);
}

TEST(RingShape, does_not_depend_on_where_the_cell_is) {
  test::Nodes nodes = test::crescent(0.5, -0.6, 59);
  for (Vector<2>& node : nodes) node = test::turned(node, -0.5);
  const RingCurve curve(nodes);
  const RingShape here = measure_shape(curve);
  const RingShape there = measure_shape(curve.moved({1e4, -1e4}));
  EXPECT_NEAR(there.deformation, here.deformation, 1e-9);
  EXPECT_NEAR(there.inclination, here.inclination, 1e-9);
  EXPECT_NEAR(there.length, here.length, 1e-9);
  EXPECT_LT((there.centroid - here.centroid - Vector<2>(1e4, -1e4)).norm(), 1e-9);
}

TEST(RingShape, inclines_to_both_sides_of_the_flow) {
  for (const double angle : {-1.5, -0.3, 0.0, 0.3, 1.5}) {
    const RingCurve curve(test::nodes_on({.angle = angle}, 60));
    EXPECT_NEAR(measure_shape(curve).inclination, angle, 1e-4);
  }
}

TEST(RingShape, refuses_a_ring_without_area) {
  const test::Nodes line = {{0, 0}, {1, 0}, {2, 0}, {1, 0}};
  EXPECT_THROW(measure_shape(RingCurve(line)), ParameterError);
}

TEST(Reach, finds_the_ends_between_the_nodes) {
  const RingCurve curve(test::nodes_on({.a = 3, .b = 1, .centre = {1, 0}}, 400));
  const Reach reach = reach_along(curve, {-1, 0});
  EXPECT_NEAR(reach.smallest, -4, 1e-8);
  EXPECT_NEAR(reach.largest, 2, 1e-8);
}

}  // namespace
}  // namespace hemoscale::micro
