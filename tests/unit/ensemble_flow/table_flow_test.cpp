#include "micro/ensemble/flow/table_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "micro/ensemble/flow/parallel_flow.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

std::shared_ptr<const GivenFlow> shear(double rate) {
  return std::make_shared<SimpleShearFlow>(rate, 1);
}

double rate_at(const GivenFlow& flow, double time) {
  return flow.at({0, 0.5}, time).gradient(0, 1);
}

TEST(TableFlow, is_linear_between_its_times_and_ends_with_them) {
  const TableFlow flow({1, 2, 4}, {shear(10), shear(30), shear(-10)});
  EXPECT_DOUBLE_EQ(rate_at(flow, 1), 10);
  EXPECT_DOUBLE_EQ(rate_at(flow, 1.5), 20);
  EXPECT_DOUBLE_EQ(rate_at(flow, 2), 30);
  EXPECT_DOUBLE_EQ(rate_at(flow, 3.5), 0);
  EXPECT_DOUBLE_EQ(rate_at(flow, 4), -10);
  EXPECT_DOUBLE_EQ(flow.at({0, 0.5}, 1.5).velocity[0], 10);
  EXPECT_THROW(rate_at(flow, 0.999), ParameterError);
  EXPECT_THROW(rate_at(flow, 4.001), ParameterError);
  EXPECT_FALSE(flow.is_steady());
  EXPECT_EQ(flow.largest_shear_rate(), 30);
  EXPECT_EQ(flow.largest_speed(), 30);
}

TEST(TableFlow, that_repeats_goes_from_the_last_flow_over_to_the_first) {
  const TableFlow flow({0, 1, 2}, {shear(0), shear(10), shear(20)}, 4.0);
  for (const double shift : {-8.0, 0.0, 4.0, 400.0}) {
    EXPECT_NEAR(rate_at(flow, shift + 0.5), 5, 1e-9);
    EXPECT_NEAR(rate_at(flow, shift + 2), 20, 1e-9);
    EXPECT_NEAR(rate_at(flow, shift + 3), 10, 1e-9);
    EXPECT_NEAR(rate_at(flow, shift + 4), 0, 1e-9);
  }
}

TEST(TableFlow, interpolates_second_derivatives_too) {
  VelocityProfile table{.height = 1, .velocities = {0, 3, 4, 3, 0}};
  const auto parabola = std::make_shared<ParallelFlow>(table);
  const TableFlow flow({0, 1}, {parabola, shear(0)});
  EXPECT_NEAR(flow.at({0, 0.3}, 0.25).second[0](1, 1), 0.75 * -32, 1e-10);
}

/// As its comment says: (w dt)^2 / 8 of the amplitude.
TEST(TableFlow, has_the_stated_error_in_time) {
  const int count = 64;
  std::vector<double> times;
  std::vector<std::shared_ptr<const GivenFlow>> flows;
  for (int k = 0; k < count; ++k) {
    times.push_back(static_cast<double>(k) / count);
    flows.push_back(shear(std::cos(2 * std::numbers::pi * times.back())));
  }
  const TableFlow flow(times, flows, 1.0);
  double largest = 0;
  for (double t = 0; t < 1; t += 1e-3) {
    largest = std::max(largest, std::abs(rate_at(flow, t) - std::cos(2 * std::numbers::pi * t)));
  }
  const double expected = std::pow(2 * std::numbers::pi / count, 2) / 8;
  EXPECT_LE(largest, expected);
  EXPECT_GE(largest, 0.95 * expected);
}

TEST(TableFlow, refuses_tables_that_are_none) {
  EXPECT_THROW(TableFlow({0}, {shear(1)}), ParameterError);
  EXPECT_THROW(TableFlow({0, 1}, {shear(1)}), ParameterError);
  EXPECT_THROW(TableFlow({0, 0}, {shear(1), shear(1)}), ParameterError);
  EXPECT_THROW(TableFlow({0, std::nan("")}, {shear(1), shear(1)}), ParameterError);
  EXPECT_THROW(TableFlow({0, 1}, {shear(1), shear(1)}, 1.0), ParameterError);
  const auto moving = std::make_shared<TableFlow>(
      std::vector<double>{0, 1}, std::vector<std::shared_ptr<const GivenFlow>>{shear(1), shear(2)});
  EXPECT_THROW(TableFlow({0, 1}, {shear(1), moving}), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
