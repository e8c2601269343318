#include "micro/cells/ring_modes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "micro/error.hpp"
#include "tests/support/micro/outlines.hpp"

namespace hemoscale::micro {
namespace {

double largest_difference(const RingModes& a, const RingModes& b) {
  double largest = 0;
  for (int k = -a.order; k <= a.order; ++k) largest = std::max(largest, std::abs(a(k) - b(k)));
  return largest;
}

TEST(RingModes, of_a_circle_are_one) {
  const RingModes modes =
      fourier_modes(RingCurve(test::nodes_on({.a = 2, .b = 2, .centre = {4, -6}}, 100)), 5);
  EXPECT_NEAR(std::abs(modes(1) - 1.0), 0, 1e-7);
  EXPECT_NEAR(std::abs(modes(0) - std::complex<double>(2, -3)), 0, 1e-6);
  for (const int k : {-5, -2, -1, 2, 5}) EXPECT_NEAR(std::abs(modes(k)), 0, 1e-7) << k;
}

// z = e^{i p} + q e^{-2 i p} has the arc length p for small q only; instead, the outline is put
// together from its modes.
TEST(RingModes, put_the_outline_together) {
  const RingCurve curve(test::crescent(0.5, -0.4, 120));
  const RingModes modes = fourier_modes(curve, 40);
  double perimeter = 0;
  for_each_point(curve, [&](double weight, const Vector<2>&, const Vector<2>& slope) {
    perimeter += weight * slope.norm();
  });
  const double radius = perimeter / (2 * std::numbers::pi);
  // Every point of the sum lies on the curve.
  for (int step = 0; step < 50; ++step) {
    std::complex<double> z = 0;
    for (int k = -40; k <= 40; ++k) z += modes(k) * std::polar(radius, 0.1256 * step * k);
    double nearest = 1;
    for (int i = 0; i < 120 * 50; ++i) {
      nearest =
          std::min(nearest, (curve.position(i / 50.0) - Vector<2>(z.real(), z.imag())).norm());
    }
    EXPECT_LT(nearest, 1e-3) << step;
  }
}

TEST(RingModes, do_not_depend_on_the_first_node) {
  const RingModes one = fourier_modes(RingCurve(test::crescent(0.5, -0.6, 200, 0.0)), 6);
  const RingModes other = fourier_modes(RingCurve(test::crescent(0.5, -0.6, 200, 2.345)), 6);
  EXPECT_LT(largest_difference(one, other), 1e-6);
}

TEST(RingModes, of_a_cell_symmetric_about_the_flow_are_real) {
  const RingModes modes = fourier_modes(RingCurve(test::crescent(0.5, -0.6, 200)), 6);
  for (int k = -6; k <= 6; ++k) EXPECT_NEAR(modes(k).imag(), 0, 1e-7) << k;
  test::Nodes tilted = test::crescent(0.5, -0.6, 200);
  for (Vector<2>& node : tilted) node = test::turned(node, 0.2);
  EXPECT_GT(std::abs(fourier_modes(RingCurve(tilted), 6)(-1).imag()), 0.01);
}

TEST(RingModes, normalised_are_those_of_the_shape_alone) {
  const test::Nodes nodes = test::crescent(0.5, -0.6, 200);
  const RingModes here = normalised(fourier_modes(RingCurve(nodes), 6));
  for (const double angle : {0.5, 2.0, 3.1, -1.0}) {
    test::Nodes moved = nodes;
    for (Vector<2>& node : moved) node = 3 * test::turned(node, angle) + Vector<2>(9, 8);
    const RingModes there = normalised(fourier_modes(RingCurve(moved), 6));
    EXPECT_LT(largest_difference(here, there), 1e-6) << angle;
  }
  EXPECT_NEAR(here(1).imag(), 0, 1e-12);
  EXPECT_NEAR(here(-1).imag(), 0, 1e-12);
  EXPECT_NEAR(here(1).real() + here(-1).real(), 1, 1e-12);
}

TEST(RingModes, refuse_waves_that_are_not_resolved) {
  const RingCurve curve(test::nodes_on({}, 30));
  EXPECT_NO_THROW(fourier_modes(curve, 10));
  EXPECT_THROW(fourier_modes(curve, 11), ParameterError);
  EXPECT_THROW(fourier_modes(curve, 0), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
