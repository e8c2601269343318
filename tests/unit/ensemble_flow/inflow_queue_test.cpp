#include "micro/ensemble/flow/inflow_queue.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "micro/ensemble/flow/parallel_flow.hpp"
#include "micro/ensemble/flow/table_flow.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

constexpr double height = 75e-6;        // [m]
constexpr double mean_velocity = 2e-3;  // [m/s]
constexpr double cell_area = 13.6e-12;  // [m^2]
const Opening inlet{"inlet", {0, height}, {0, 0}};

std::shared_ptr<const GivenFlow> poiseuille(double scale = 1) {
  VelocityProfile table;
  table.height = height;
  for (int k = 0; k <= 16; ++k) {
    const double s = k / 16.0;
    table.velocities.push_back(scale * 6 * mean_velocity * s * (1 - s));
  }
  return std::make_shared<ParallelFlow>(table);
}

TEST(InflowQueue, lets_in_as_much_as_the_flow_carries) {
  const double hematocrit = 0.4;
  InflowQueue queue(inlet, {.hematocrit = hematocrit}, poiseuille(), 1, 0);
  const double duration = 0.5;  // [s]
  std::uint64_t taken = 0;
  for (int step = 0; step < 1000; ++step) {
    queue.advance(step * duration / 1000, duration / 1000);
    for (; queue.due(cell_area) > 0; ++taken) queue.take(cell_area, 0);
  }
  const double expected = hematocrit * mean_velocity * height * duration / cell_area;
  EXPECT_EQ(taken, static_cast<std::uint64_t>(expected));
  EXPECT_EQ(queue.state().arrivals, taken);
  EXPECT_NEAR(queue.state().area / cell_area, expected - std::floor(expected), 1e-9);
}

TEST(InflowQueue, does_not_depend_on_the_step) {
  InflowQueue coarse(inlet, {.hematocrit = 0.3}, poiseuille(), 7, 3);
  InflowQueue fine(inlet, {.hematocrit = 0.3}, poiseuille(), 7, 3);
  coarse.advance(0, 0.1);
  for (int k = 0; k < 64; ++k) fine.advance(k * 0.1 / 64, 0.1 / 64);
  ASSERT_EQ(coarse.due(cell_area), fine.due(cell_area));
  ASSERT_GT(coarse.due(cell_area), 100U);
  while (coarse.due(cell_area) > 0) {
    const Arrival a = coarse.take(cell_area, 0.1);
    const Arrival b = fine.take(cell_area, 0.1);
    EXPECT_EQ(a.place, b.place);
    EXPECT_EQ(a.angle, b.angle);
  }
}

TEST(InflowQueue, continues_from_its_state_and_differs_by_seed_and_stream) {
  InflowQueue whole(inlet, {.hematocrit = 0.3}, poiseuille(), 7, 3);
  whole.advance(0, 0.01);
  whole.take(cell_area, 0);
  InflowQueue resumed(inlet, {.hematocrit = 0.3}, poiseuille(), 7, 3);
  resumed.restore(whole.state());
  EXPECT_EQ(resumed.due(cell_area), whole.due(cell_area));
  const Arrival next = whole.take(cell_area, 0);
  EXPECT_EQ(resumed.take(cell_area, 0).place, next.place);
  for (const auto& [seed, stream] : {std::pair{8, 3}, {7, 4}}) {
    InflowQueue other(inlet, {.hematocrit = 0.3}, poiseuille(), static_cast<std::uint64_t>(seed),
                      static_cast<std::uint64_t>(stream));
    other.advance(0, 0.01);
    other.take(cell_area, 0);
    EXPECT_NE(other.take(cell_area, 0).place, next.place);
  }
}

TEST(InflowQueue, keeps_the_clearance_and_the_bins_of_the_profile) {
  const double clearance = 5e-6;
  InflowQueue queue(inlet, {.hematocrit = 0.5, .clearance = clearance, .profile = {1, 0, 0, 1}},
                    poiseuille(), 2, 0);
  queue.advance(0, 1);
  for (int k = 0; k < 500; ++k) {
    const double along = height - queue.take(cell_area, 0).place[1];
    EXPECT_TRUE((along >= clearance && along <= height / 4) ||
                (along >= 0.75 * height && along <= height - clearance))
        << along;
  }
}

/// The flow u = U (1 + cos 2 pi t): the integral over a period is U.
TEST(InflowQueue, follows_a_flow_in_time) {
  const int count = 200;
  std::vector<double> times;
  std::vector<std::shared_ptr<const GivenFlow>> flows;
  for (int k = 0; k < count; ++k) {
    times.push_back(static_cast<double>(k) / count);
    flows.push_back(poiseuille(1 + std::cos(2 * std::numbers::pi * times.back())));
  }
  const auto flow = std::make_shared<TableFlow>(times, flows, 1.0);
  InflowQueue queue(inlet, {.hematocrit = 0.25}, flow, 1, 0);
  for (int k = 0; k < 50; ++k) queue.advance(k / 50.0, 1.0 / 50);
  EXPECT_NEAR(queue.state().area, 0.25 * mean_velocity * height,
              1e-4 * 0.25 * mean_velocity * height);
}

TEST(InflowQueue, of_a_flow_that_leaves_lets_nothing_in) {
  InflowQueue queue(inlet, {.hematocrit = 0.25}, poiseuille(-1), 1, 0);
  queue.advance(0, 10);
  EXPECT_EQ(queue.state().area, 0);
  EXPECT_EQ(queue.due(cell_area), 0U);
  EXPECT_THROW(queue.take(cell_area, 0), NumericalError);
}

TEST(InflowQueue, says_if_centres_have_no_place) {
  // Flow through the upper half alone, cells in the lower half alone.
  VelocityProfile table{.height = height, .velocities = std::vector<double>(9, 0)};
  table.velocities[7] = 1e-3;
  const auto flow = std::make_shared<ParallelFlow>(table);
  InflowQueue queue({"up", {0, height}, {0, 0}},
                    {.hematocrit = 0.4, .profile = {0, 0, 0, 0, 0, 0, 0, 1}}, flow, 1, 0);
  queue.advance(0, 10);
  ASSERT_GT(queue.due(cell_area), 0U);
  EXPECT_THROW(queue.take(cell_area, 10), NumericalError);
}

TEST(InflowQueue, refuses_feeds_that_are_none) {
  const auto made = [](const Feed& feed) { return InflowQueue(inlet, feed, poiseuille(), 1, 0); };
  EXPECT_NO_THROW(made({.hematocrit = 0}));
  EXPECT_THROW(made({.hematocrit = 1}), ParameterError);
  EXPECT_THROW(made({.hematocrit = -0.1}), ParameterError);
  EXPECT_THROW(made({.hematocrit = 0.4, .clearance = height / 2}), ParameterError);
  EXPECT_THROW(made({.hematocrit = 0.4, .clearance = -1e-9}), ParameterError);
  EXPECT_THROW(made({.hematocrit = 0.4, .profile = {0, 0}}), ParameterError);
  EXPECT_THROW(made({.hematocrit = 0.4, .profile = {1, -1, 3}}), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
