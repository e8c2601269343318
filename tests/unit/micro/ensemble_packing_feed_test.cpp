#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "micro/ensemble/packing/cell_feed.hpp"
#include "micro/ensemble/packing/platelets.hpp"
#include "micro/ensemble/packing/state_checks.hpp"
#include "tests/support/micro/packed_cells.hpp"

namespace hemoscale::micro {
namespace {

using test::refusal;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double um = 1e-6;
constexpr double height = 30 * um;
constexpr double length = 100 * um;
constexpr double speed = 1e-3;  // [m/s]
const std::vector<Vector<2>> human = outline_nodes({}, 40);

blocks::BlockSettings channel(
    blocks::Integrator integrator = blocks::Integrator::linearly_implicit) {
  blocks::BlockSettings s;
  s.kinds = {test::kind_of(human), make_platelets({}, 1.2e-3).kind};
  s.contact = make_pair_potential(1, 0.5 * um, 0.8 * um, 0.05);
  s.flow = std::make_shared<test::UniformFlow>(Vector<2>(speed, 0));
  s.plane_walls = WallPotential{.stiffness = 1, .range = 0.5 * um};
  s.height = height;
  s.time_step = 1e-4;
  s.integrator = integrator;
  return s;
}

FeedPlan plan_of(double hematocrit) {
  FeedPlan plan;
  plan.inlets = {{.kind = 0,
                  .outline = human,
                  .inlet = {"inlet", {0, height}, {0, 0}},
                  .feed = {.hematocrit = hematocrit, .clearance = 2 * um}}};
  plan.outlets = {{"upper", {length, 0.4 * height}, {length, height}},
                  {"lower", {length, 0}, {length, 0.4 * height}}};
  plan.overhang = 12 * um;
  plan.room = {.height = height, .plane_walls = true};
  plan.clearance = {.cells = 0.5 * um, .walls = 0.5 * um};
  return plan;
}

/// A channel without cells.
BlockEnsemble empty_channel(const blocks::BlockSettings& settings) {
  std::vector<EnsembleState> none(settings.kinds.size());
  for (std::size_t k = 0; k < none.size(); ++k) {
    none[k].nodes = static_cast<std::size_t>(settings.kinds[k].mesh.nodes);
  }
  return {settings, Precision::single, none};
}

std::uint64_t sum(const std::vector<std::uint64_t>& numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), std::uint64_t{0});
}

TEST(BlockExchange, takes_cells_out_and_numbers_new_ones_upwards) {
  const blocks::BlockSettings settings = channel();
  const EnsembleState red =
      test::state_of(human, {{{10 * um, 10 * um}}, {{30 * um, 10 * um}}, {{50 * um, 10 * um}}});
  EnsembleState none;
  none.nodes = 28;
  BlockEnsemble ensemble(settings, Precision::single, {red, none});
  ensemble.advance(3);
  EXPECT_THAT(ensemble.identities(), ElementsAre(ElementsAre(0, 1, 2), ElementsAre()));
  const auto small = make_platelets({}, 1.2e-3).outline;
  const auto numbers =
      ensemble.exchange({1}, {test::state_of(human, {{{70 * um, 15 * um}}}),
                              test::state_of(small, {{{20 * um, 10 * um}}, {{5 * um, 20 * um}}})});
  EXPECT_THAT(numbers, ElementsAre(3, 4, 5));
  EXPECT_THAT(ensemble.identities(), ElementsAre(ElementsAre(0, 2, 3), ElementsAre(4, 5)));
  const auto states = ensemble.states();
  EXPECT_EQ(states[0].cells, 3U);
  EXPECT_EQ(states[1].cells, 2U);
  EXPECT_NEAR(states[0].x[2 * 40], 70 * um + 0.5 * 7.82 * um, 1e-12);
  ensemble.advance(5);
  for (const auto& [number, x] :
       {std::pair{0, 10 * um + 8 * speed * 1e-4}, std::pair{3, 70 * um + 5 * speed * 1e-4}}) {
    Vector<2> centre = Vector<2>::Zero();
    for (const auto& node : ensemble.nodes_of(number)) centre += node / 40;
    EXPECT_NEAR(centre.x(), x, 2e-3 * um);
  }
  EXPECT_EQ(ensemble.frames()[1].size(), 2U);
  EXPECT_NEAR(ensemble.frames()[1][1].y(), 20 * um, 0.01 * um);
  EXPECT_THAT(refusal([&] { ensemble.exchange({1}, {none, none}); }), HasSubstr("cell 1"));
  EXPECT_THROW(ensemble.nodes_of(1), ParameterError);
  EXPECT_THROW(ensemble.nodes_of(77), ParameterError);
}

// Those that stay continue with the same bits, whatever comes and goes far away.
TEST(BlockExchange, does_not_touch_those_that_stay) {
  for (const auto integrator :
       {blocks::Integrator::linearly_implicit, blocks::Integrator::constant_operator_second_order,
        blocks::Integrator::explicit_euler}) {
    blocks::BlockSettings settings = channel(integrator);
    if (integrator == blocks::Integrator::explicit_euler) settings.time_step = 2e-7;
    const EnsembleState red = test::state_of(
        human, {{{10 * um, 10 * um}, 0.4}, {{17 * um, 12 * um}, 1.2}, {{60 * um, 10 * um}, 0.2}});
    EnsembleState none;
    none.nodes = 28;
    EnsembleState no_red;
    no_red.nodes = 40;
    BlockEnsemble usual(settings, Precision::single, {red, none});
    BlockEnsemble changed(settings, Precision::single, {red, none});
    usual.advance(40);
    changed.advance(20);
    changed.exchange({2}, {test::state_of(human, {{{200 * um, 10 * um}}}), none});
    changed.advance(10);
    changed.exchange({3}, {no_red, none});
    changed.advance(10);
    for (const blocks::CellId cell : {0, 1}) {
      EXPECT_EQ(changed.nodes_of(cell), usual.nodes_of(cell)) << static_cast<int>(integrator);
    }
  }
}

// A cell that enters moves with the flow from its first step on.
TEST(BlockExchange, lets_cells_enter_in_motion) {
  const blocks::BlockSettings settings =
      channel(blocks::Integrator::constant_operator_second_order);
  BlockEnsemble ensemble = empty_channel(settings);
  ensemble.advance(4);
  EnsembleState none;
  none.nodes = 28;
  ensemble.exchange({}, {test::state_of(human, {{{10 * um, 15 * um}}}), none});
  const auto before = ensemble.nodes_of(0);
  ensemble.advance(1);
  const auto after = ensemble.nodes_of(0);
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_NEAR(after[i].x() - before[i].x(), speed * settings.time_step, 1e-4 * um);
    EXPECT_NEAR(after[i].y() - before[i].y(), 0, 1e-4 * um);
  }
}

TEST(CellFeed, settles_at_the_hematocrit_and_balances_exactly) {
  const blocks::BlockSettings settings = channel();
  for (const double hematocrit : {0.1, 0.3}) {
    BlockEnsemble ensemble = empty_channel(settings);
    CellFeed feed(plan_of(hematocrit), settings, 1, 0);
    const double cell_area = settings.kinds[0].mesh.rest_area;
    double mean = 0;
    int samples = 0;
    const std::int64_t transit = std::lround(length / (speed * settings.time_step));  // [steps]
    for (int k = 0; k < 30; ++k) {
      feed.advance(ensemble, transit / 10);
      const FeedCounts& counts = feed.counts()[0];
      ASSERT_EQ(ensemble.identities()[0].size(), counts.entered - sum(counts.left));
      const std::vector<EnsembleState> states = ensemble.states();
      if (k % 10 == 9) {
        EXPECT_THAT(state_faults(states, {.height = height, .plane_walls = true}),
                    testing::IsEmpty());
      }
      if (k < 20) continue;
      const std::vector<Vector<2>> places = ensemble.frames()[0];
      for (const Vector<2>& place : places) {
        mean += place.x() > 10 * um && place.x() < 90 * um ? cell_area : 0;
      }
      ++samples;
    }
    mean /= samples * 80 * um * height;
    EXPECT_NEAR(mean, hematocrit, 0.05 * hematocrit);
    // What had flowed in when the feed looked last is in whole cells, or waits.
    const FeedCounts& counts = feed.counts()[0];
    const std::int64_t looked = ensemble.step() / feed.interval() * feed.interval();
    const double area =
        hematocrit * speed * height * settings.time_step * static_cast<double>(looked);
    EXPECT_EQ(counts.entered + counts.waiting, static_cast<std::uint64_t>(area / cell_area));
    // Each outlet receives its part of the opening.
    const double upper =
        static_cast<double>(counts.left[0]) / static_cast<double>(sum(counts.left));
    EXPECT_NEAR(upper, 0.6, 4 * std::sqrt(0.24 / static_cast<double>(sum(counts.left))));
  }
}

TEST(CellFeed, feeds_two_kinds_and_continues_from_a_snapshot_with_the_same_bits) {
  const blocks::BlockSettings settings = channel();
  FeedPlan plan = plan_of(0.2);
  plan.inlets.push_back({.kind = 1,
                         .outline = make_platelets({}, 1.2e-3).outline,
                         .inlet = plan.inlets[0].inlet,
                         .feed = {.hematocrit = 0.01, .clearance = 1 * um}});
  BlockEnsemble usual = empty_channel(settings);
  CellFeed usual_feed(plan, settings, 3, 1);
  usual_feed.advance(usual, 1200);

  BlockEnsemble first = empty_channel(settings);
  CellFeed first_feed(plan, settings, 3, 1);
  first_feed.advance(first, 501);
  BlockEnsemble second = empty_channel(settings);
  CellFeed second_feed(plan, settings, 3, 1);
  second.restore(first.snapshot());
  second_feed.restore(first_feed.snapshot());
  second_feed.advance(second, 699);

  EXPECT_GT(usual_feed.counts()[1].entered, 3U);
  EXPECT_GT(sum(usual_feed.counts()[0].left), 3U);
  EXPECT_EQ(second.identities(), usual.identities());
  EXPECT_EQ(second.snapshot().reals, usual.snapshot().reals);
  EXPECT_EQ(second_feed.snapshot().reals, usual_feed.snapshot().reals);
  EXPECT_EQ(second_feed.snapshot().integers, usual_feed.snapshot().integers);
}

TEST(CellFeed, ends_a_run_whose_hematocrit_does_not_enter) {
  const blocks::BlockSettings settings = channel();
  BlockEnsemble ensemble = empty_channel(settings);
  FeedPlan plan = plan_of(0.8);
  plan.largest_backlog = 5;
  CellFeed feed(plan, settings, 1, 0);
  try {
    feed.advance(ensemble, 3000);
    FAIL() << feed.counts()[0].entered;
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("6 cells wait for a free place at inlet"));
  }
}

TEST(CellFeed, refuses_plans_that_do_not_fit) {
  const auto with = [](const std::function<void(FeedPlan&, blocks::BlockSettings&)>& change) {
    FeedPlan plan = plan_of(0.2);
    blocks::BlockSettings settings = channel();
    change(plan, settings);
    return refusal([&] { CellFeed(plan, settings, 1, 0); });
  };
  EXPECT_THAT(with([](FeedPlan&, auto& s) { s.length = length; }), HasSubstr("repeats itself"));
  EXPECT_THAT(with([](FeedPlan& p, auto&) { p.overhang = 0; }), HasSubstr("finite and positive"));
  EXPECT_THAT(with([](FeedPlan& p, auto&) { p.overhang = 3 * um; }), HasSubstr("lengthen"));
  EXPECT_THAT(with([](FeedPlan&, auto& s) { s.time_step = 1e-2; }), HasSubstr("reduce the step"));
  EXPECT_THAT(with([](FeedPlan& p, auto&) { p.inlets[0].kind = 2; }), HasSubstr("has 2 kinds"));
  EXPECT_THAT(with([](FeedPlan& p, auto&) { p.inlets[0].outline.pop_back(); }),
              HasSubstr("39 nodes"));
  EXPECT_THAT(with([](FeedPlan& p, auto&) { p.outlets[0].b = p.outlets[0].a; }),
              HasSubstr("upper"));
  CellFeed feed(plan_of(0.2), channel(), 1, 0);
  EXPECT_THROW(feed.restore({}), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
