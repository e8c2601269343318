#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "coupling/error.hpp"
#include "coupling/sampling/sample_flow.hpp"
#include "coupling/sampling/sample_points.hpp"
#include "tests/support/coupling_doubles.hpp"

namespace hemoscale::coupling {
namespace {

using ::testing::HasSubstr;

TEST(PointsAcross, shear_rates_of_a_parabola_are_even_in_their_logarithm) {
  const macro::Vector<2> axis(0.3, 50e-6);
  const macro::Vector<2> wall(0.3, 0);
  const auto points = points_across<2>(axis, wall, 5, 0.1);
  ASSERT_EQ(points.size(), 5u);
  std::vector<double> rates;  // of u = y (h - y), over those at the wall
  for (const auto& x : points) rates.push_back(std::abs(100e-6 - 2 * x[1]) / 100e-6);
  EXPECT_NEAR(rates.front(), 0.1, 1e-12);
  for (std::size_t k = 1; k < rates.size(); ++k) {
    EXPECT_NEAR(rates[k] / rates[k - 1], std::pow(10.0, 0.25), 1e-10);
  }
}

TEST(PointsAcross, last_point_is_the_wall_to_the_bit) {
  const macro::Vector<3> axis(0.1, 0.2, 0.3);
  const macro::Vector<3> wall(0.1, 0.7 / 3, 0.9);
  EXPECT_EQ(points_across<3>(axis, wall, 7, 0.3).back(), wall);
  const auto single = points_across<3>(axis, wall, 1, 0.0);
  ASSERT_EQ(single.size(), 1u);
  EXPECT_EQ(single.front(), wall);
}

TEST(PointsAcross, refuses_what_gives_no_even_spacing) {
  const macro::Vector<2> axis(0, 1);
  const macro::Vector<2> wall(0, 0);
  for (const double closest : {0.0, 1.0, -0.1, std::nan("")}) {
    try {
      points_across<2>(axis, wall, 2, closest);
      FAIL() << closest;
    } catch (const CaseError& error) {
      EXPECT_EQ(error.faults().at(0).key, "sampling.closest_to_axis");
    }
  }
  EXPECT_NO_THROW(points_across<2>(axis, wall, 2, 0.999));
  EXPECT_THROW(points_across<2>(axis, wall, 0, 0.1), CaseError);
}

TEST(ExplicitPoints, plane_flow_takes_the_first_two_coordinates) {
  const auto points = explicit_points<2>({{1, 2, 0}, {3, 4, 0}});
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[1], macro::Vector<2>(3, 4));
  EXPECT_EQ(explicit_points<3>({{1, 2, 5}}).at(0), macro::Vector<3>(1, 2, 5));
}

TEST(ExplicitPoints, all_bad_points_are_named_at_once) {
  const double infinity = std::numeric_limits<double>::infinity();
  try {
    explicit_points<2>({{0, 0, 1e-9}, {1, 1, 0}, {infinity, 0, 0}});
    FAIL();
  } catch (const CaseError& error) {
    ASSERT_EQ(error.faults().size(), 2u);
    EXPECT_THAT(error.faults()[0].message, HasSubstr("point 1"));
    EXPECT_THAT(error.faults()[1].message, HasSubstr("point 3"));
    EXPECT_EQ(error.faults()[0].key, "sampling.points");
  }
}

TEST(SampleFlow, answers_in_the_order_of_the_points) {
  macro::Tensor<2> gradient;
  gradient << 1, 2, 3, -1;
  const testing::UniformGradient<2> field(gradient);
  const auto states = sample_flow<2>(field, {{0.5, 0}, {0, 1}}, 0);
  ASSERT_EQ(states.size(), 2u);
  EXPECT_EQ(states[0].velocity, macro::Vector<2>(0.5, 1.5));
  EXPECT_EQ(states[1].velocity, macro::Vector<2>(2, -1));
}

TEST(SampleFlow, every_point_outside_is_a_fault_with_its_coordinates) {
  const testing::UniformGradient<2> field(macro::Tensor<2>::Identity());
  try {
    sample_flow<2>(field, {{0, 0}, {7, 0}, {0, -8.5}}, 0);
    FAIL();
  } catch (const CaseError& error) {
    ASSERT_EQ(error.faults().size(), 2u);
    EXPECT_THAT(error.faults()[0].message, HasSubstr("point 2 = (7, 0) m"));
    EXPECT_THAT(error.faults()[1].message, HasSubstr("point 3 = (0, -8.5) m"));
  }
}

TEST(SampleFlow, a_gradient_that_is_not_finite_is_a_numerical_error) {
  const testing::UniformGradient<3> field(macro::Tensor<3>::Constant(std::nan("")));
  EXPECT_THROW(sample_flow<3>(field, {macro::Vector<3>::Zero()}, 0), NumericalError);
}

}  // namespace
}  // namespace hemoscale::coupling
