#include "micro/cells/ring_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "micro/error.hpp"
#include "tests/support/micro/outlines.hpp"

namespace hemoscale::micro {
namespace {

TEST(RingCurve, passes_through_the_nodes_and_is_twice_differentiable) {
  for (const int n : {4, 5, 17}) {
    const test::Nodes nodes = test::nodes_on({.a = 3, .b = 0.5, .angle = 1, .centre = {7, 2}}, n);
    const RingCurve curve(nodes);
    for (int i = 0; i < n; ++i) {
      const double inside = 1e-9;
      EXPECT_LT((curve.position(i) - nodes[static_cast<std::size_t>(i)]).norm(), 1e-14);
      EXPECT_LT((curve.derivative(i + inside) - curve.derivative(i - inside)).norm(), 1e-7);
      EXPECT_LT((curve.second_derivative(i + inside) - curve.second_derivative(i - inside)).norm(),
                1e-7);
    }
  }
}

TEST(RingCurve, repeats_after_one_turn) {
  const RingCurve curve(test::nodes_on({}, 9));
  EXPECT_LT((curve.position(2.25) - curve.position(11.25)).norm(), 1e-14);
  EXPECT_LT((curve.position(2.25) - curve.position(-6.75)).norm(), 1e-14);
  EXPECT_LT((curve.position(-1e-20) - curve.position(0)).norm(), 1e-14);
}

TEST(RingCurve, has_a_position_of_fourth_a_tangent_of_third_order) {
  const auto error = [](int n, bool of_tangent) {
    const RingCurve curve(test::nodes_on({.start = 0}, n));
    double largest = 0;
    for (int k = 0; k < 1000; ++k) {
      const double s = n * k / 1000.0;
      const double phase = 2 * std::numbers::pi * s / n;
      const Vector<2> exact(3 * std::cos(phase), std::sin(phase));
      const Vector<2> tangent(-3 * std::sin(phase), std::cos(phase));
      const Vector<2> seen =
          of_tangent ? curve.derivative(s) * n / (2 * std::numbers::pi) : curve.position(s);
      largest = std::max(largest, (seen - (of_tangent ? tangent : exact)).norm());
    }
    return largest;
  };
  EXPECT_NEAR(test::observed_order(error(20, false), error(80, false), 4), 4, 0.15);
  EXPECT_NEAR(test::observed_order(error(20, true), error(80, true), 4), 3, 0.15);
}

TEST(RingCurve, refuses_what_is_no_ring) {
  const test::Nodes nodes = test::nodes_on({}, 4);
  EXPECT_NO_THROW(RingCurve{nodes});
  EXPECT_THROW(RingCurve(std::span(nodes).first(3)), ParameterError);
  test::Nodes broken = nodes;
  broken[2].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(RingCurve{broken}, ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
