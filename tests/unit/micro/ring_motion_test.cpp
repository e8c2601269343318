#include "micro/cells/ring_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "micro/cells/ring_shape.hpp"
#include "micro/error.hpp"
#include "tests/support/micro/outlines.hpp"

namespace hemoscale::micro {
namespace {

using Field = std::function<Vector<2>(const Vector<2>&)>;

RingMotion motion_in(const test::Nodes& nodes, const Field& field) {
  test::Nodes velocities;
  for (const Vector<2>& node : nodes) velocities.push_back(field(node));
  return measure_motion(RingCurve(nodes), RingCurve(velocities));
}

const test::Nodes slanted = test::nodes_on({.a = 3, .b = 1, .angle = 0.4, .centre = {10, 4}}, 200);

TEST(RingMotion, of_a_rigid_body_is_found_exactly) {
  const RingMotion motion = motion_in(slanted, [](const Vector<2>& r) {
    return Vector<2>(5 - 2 * (r.y() - 4), -1 + 2 * (r.x() - 10));
  });
  EXPECT_LT((motion.velocity - Vector<2>(5, -1)).norm(), 1e-7);
  EXPECT_NEAR(motion.rigid_rate, 2, 1e-9);
  EXPECT_NEAR(motion.inclination_rate, 2, 1e-7);
  EXPECT_NEAR(motion.relative_speed, 0, 1e-9);
  EXPECT_NEAR(motion.largest_relative, 0, 1e-9);
  // Tangential velocity of a rotation: 2 omega A / P on average.
  const RingShape shape = measure_shape(RingCurve(slanted));
  EXPECT_NEAR(motion.tangential_speed, 2 * 2 * shape.area / shape.perimeter, 1e-7);
}

// A membrane that slides along itself with one speed: the shape rests.
TEST(RingMotion, of_a_membrane_that_slides_along_itself) {
  const RingCurve curve(slanted);
  test::Nodes velocities;
  for (std::size_t i = 0; i < slanted.size(); ++i) {
    velocities.push_back(Vector<2>(0.5, 0) -
                         7 * curve.derivative(static_cast<double>(i)).normalized());
  }
  const RingMotion motion = measure_motion(curve, RingCurve(velocities));
  EXPECT_LT((motion.velocity - Vector<2>(0.5, 0)).norm(), 1e-5);
  EXPECT_NEAR(motion.tangential_speed, -7, 1e-5);
  EXPECT_NEAR(motion.treading_rate, -7 * 2 * std::numbers::pi / measure_shape(curve).perimeter,
              1e-5);
  EXPECT_NEAR(motion.inclination_rate, 0, 1e-5);
  EXPECT_GT(motion.relative_speed, 1);
}

// Of a circle in the shear u = G y: the membrane turns at half the rate.
TEST(RingMotion, of_a_circle_in_shear) {
  const RingMotion motion = motion_in(test::nodes_on({.a = 2, .b = 2}, 100),
                                      [](const Vector<2>& r) { return Vector<2>(3 * r.y(), 0); });
  EXPECT_NEAR(motion.treading_rate, -1.5, 1e-6);
  EXPECT_NEAR(motion.rigid_rate, -1.5, 1e-6);
  EXPECT_TRUE(std::isnan(motion.inclination_rate));
  // What is left is the strain, of speed G R / 2 everywhere.
  EXPECT_NEAR(motion.relative_speed, 3, 1e-5);
  EXPECT_NEAR(motion.largest_relative, 3, 1e-5);
}

TEST(RingMotion, has_the_velocity_of_the_centroid_and_the_rate_of_the_axis) {
  // A flow that is not divergence-free and bends the cell; rates by differences.
  const Field field = [](const Vector<2>& r) {
    return Vector<2>(0.3 * r.x() + 0.02 * r.y() * r.y(), 0.1 * r.x() - 0.01 * r.x() * r.y());
  };
  const auto shape_after = [&](double step) {
    test::Nodes moved = slanted;
    for (Vector<2>& node : moved) node += step * field(Vector<2>(node));
    return measure_shape(RingCurve(moved));
  };
  const RingMotion motion = motion_in(slanted, field);
  const double h = 1e-5;
  const RingShape before = shape_after(-h);
  const RingShape after = shape_after(h);
  EXPECT_LT((motion.velocity - (after.centroid - before.centroid) / (2 * h)).norm(), 1e-7);
  EXPECT_NEAR(motion.inclination_rate, (after.inclination - before.inclination) / (2 * h), 1e-7);
}

TEST(RingMotion, refuses_another_number_of_velocities) {
  EXPECT_THROW(measure_motion(RingCurve(slanted), RingCurve(std::span(slanted).first(100))),
               ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
