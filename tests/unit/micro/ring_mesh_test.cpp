#include "micro/cells/ring_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "micro/cells/half_angle_bending.hpp"
#include "micro/cells/turning_angle_bending.hpp"
#include "micro/error.hpp"
#include "tests/support/micro/rings.hpp"

namespace hemoscale::micro {
namespace {

TEST(RingMesh, knows_the_measures_of_a_square) {
  const RingMesh mesh = make_ring_mesh({{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}, NaturalShape::outline);
  EXPECT_DOUBLE_EQ(mesh.rest_area, 4);
  EXPECT_DOUBLE_EQ(mesh.rest_perimeter, 8);
  for (const double angle : mesh.natural_angle) {
    EXPECT_DOUBLE_EQ(angle, std::numbers::pi / 2);
  }
}

TEST(RingMesh, flat_natural_shape_has_no_angles) {
  const RingMesh mesh = make_ring_mesh(test::regular_polygon(12, 1), NaturalShape::flat);
  for (const double angle : mesh.natural_angle) {
    EXPECT_EQ(angle, 0);
  }
}

TEST(RingMesh, spontaneous_curvature_turns_in_proportion_to_length) {
  const test::Polygon polygon = test::random_polygon(30, 1);
  const double curvature = -2e5;
  const RingMesh mesh = make_ring_mesh(polygon, NaturalShape::curvature, curvature);
  for (std::size_t i = 0; i < 30; ++i) {
    EXPECT_DOUBLE_EQ(mesh.natural_angle[i], curvature * mesh.node_length[i]);
    EXPECT_DOUBLE_EQ(mesh.natural_half_tangent[i], std::tan(0.5 * mesh.natural_angle[i]));
  }
  // By pi or more at a node, not finite, or not the natural shape that has a curvature.
  EXPECT_THROW(make_ring_mesh(polygon, NaturalShape::curvature, 1e8), ParameterError);
  EXPECT_THROW(make_ring_mesh(polygon, NaturalShape::curvature, std::nan("")), ParameterError);
  EXPECT_THROW(make_ring_mesh(polygon, NaturalShape::flat, curvature), ParameterError);
}

TEST(RingMesh, refuses_clockwise_coincident_and_too_few_nodes) {
  EXPECT_THROW(make_ring_mesh({{1, -1}, {-1, -1}, {-1, 1}, {1, 1}}, NaturalShape::flat),
               ParameterError);
  EXPECT_THROW(make_ring_mesh({{1, 1}, {1, 1}, {-1, -1}, {1, -1}}, NaturalShape::flat),
               ParameterError);
  EXPECT_THROW(make_ring_mesh({{1, 1}, {0, 0}}, NaturalShape::flat), ParameterError);
  EXPECT_THROW(make_ring_mesh({{1, 1}, {-1, 1}, {std::nan(""), -1}, {1, -1}}, NaturalShape::flat),
               ParameterError);
}

// Regular 59-gon, k_b = 1: E = (k_b/2) N tan^2(pi/N) = 0.0837990661, known in closed form.
TEST(HalfAngleBending, has_the_exact_energy_of_a_regular_polygon) {
  constexpr int n = 59;
  const test::Polygon polygon = test::regular_polygon(n, 3e-6);
  const RingMesh mesh = make_ring_mesh(polygon, NaturalShape::flat);
  const HalfAngleBending law{mesh.node_length[0] / 4};  // makes k_b one
  const double exact = 0.5 * n * std::pow(std::tan(std::numbers::pi / n), 2);
  EXPECT_NEAR(exact, 0.0837990661, 5e-11);
  EXPECT_NEAR(test::ring_energy_of(law, mesh, polygon), exact, 1e-12);
  // A uniform dilation changes no angle: the radial, equal forces are zero.
  const double scale = 1 / 3e-6;  // [N/m] k_b over the radius
  EXPECT_LE(test::largest_norm(test::ring_forces_of(law, mesh, polygon)), 1e-12 * scale);
}

TEST(TurningAngleBending, has_the_exact_energy_of_a_regular_polygon) {
  constexpr int n = 59;
  const test::Polygon polygon = test::regular_polygon(n, 3e-6);
  const RingMesh mesh = make_ring_mesh(polygon, NaturalShape::flat);
  const double turn = 2 * std::numbers::pi / n;
  const double exact = 0.5 * 2e-19 * n * turn * turn / mesh.node_length[0];
  EXPECT_NEAR(test::ring_energy_of(TurningAngleBending{2e-19}, mesh, polygon), exact,
              1e-13 * exact);
}

// The law must agree with atan2 at every angle, on both sides of the point where its polynomial
// ends.
TEST(TurningAngleBending, measures_angles_of_both_signs_up_to_folding) {
  for (double angle = -3.1; angle <= 3.1; angle += 0.0137) {
    const Vector<2> outgoing(std::cos(angle), std::sin(angle));
    const test::Polygon polygon = {{-1, 0}, {0, 0}, outgoing, {-0.3, 1.9}};
    const test::Coordinates c(polygon);
    RingGeometry ring(4);
    measure(c.x.data(), c.y.data(), ring);
    std::vector<double> angles(4);
    turning_angles(ring, angles.data());
    EXPECT_NEAR(angles[1], angle, 4e-15 * std::max(1.0, 1 / (3.15 - std::abs(angle))));
  }
}

}  // namespace
}  // namespace hemoscale::micro
