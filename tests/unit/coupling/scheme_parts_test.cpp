#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "coupling/error.hpp"
#include "coupling/scheme/byte_stream.hpp"
#include "coupling/scheme/convergence.hpp"
#include "coupling/scheme/relaxation.hpp"
#include "coupling/scheme/shear_groups.hpp"

namespace hemoscale::coupling {
namespace {

using ::testing::ElementsAre;

TEST(Relaxation, constant_factor_ignores_the_residuals) {
  const Relaxation relaxation = ConstantRelaxation{0.4};
  EXPECT_EQ(initial_factor(relaxation), 0.4);
  EXPECT_EQ(next_factor(relaxation, 0.7, {1, 2}, {3, 4}, {1, 1}).factor, 0.4);
}

// x -> a x + b has residual (a - 1) x + b; Aitken's factor is 1 / (1 - a), which solves it.
TEST(Relaxation, aitken_solves_a_linear_problem_of_one_unknown) {
  const double a = -1.7;
  const double b = 2;
  double x = 0.3;
  const double r0 = a * x + b - x;
  x += 0.5 * r0;
  const double r1 = a * x + b - x;
  const FactorChoice choice = next_factor(AitkenRelaxation{}, 0.5, {r0}, {r1}, {1});
  EXPECT_NEAR(choice.factor, 1 / (1 - a), 1e-14);
  x += choice.factor * r1;
  EXPECT_NEAR(x, b / (1 - a), 1e-14);
  EXPECT_FALSE(choice.bounded);
}

TEST(Relaxation, aitken_uses_the_weighted_inner_product) {
  // r0 = (1, 2), r1 = (0, 3): difference (-1, 1).
  const double factor = next_factor(AitkenRelaxation{}, 1, {1, 2}, {0, 3}, {3, 1}).factor;
  EXPECT_DOUBLE_EQ(factor, -(3 * 1 * -1 + 1 * 2 * 1) / (3.0 + 1.0));
}

TEST(Relaxation, aitken_keeps_its_factor_if_the_residual_stays) {
  EXPECT_EQ(next_factor(AitkenRelaxation{}, 0.7, {1, 2}, {1, 2}, {1, 1}).factor, 0.7);
}

TEST(Relaxation, bounds_of_aitken_are_reported) {
  AitkenRelaxation aitken;
  aitken.lowest_factor = 0.1;
  aitken.highest_factor = 3;
  const FactorChoice high = next_factor(aitken, 1, {1}, {0.9}, {1});  // 10 without bound
  EXPECT_EQ(high.factor, 3);
  EXPECT_TRUE(high.bounded);
  const FactorChoice low = next_factor(aitken, 1, {1}, {2}, {1});  // -1 without bound
  EXPECT_EQ(low.factor, 0.1);
  EXPECT_TRUE(low.bounded);
  EXPECT_NEAR(next_factor(AitkenRelaxation{}, 1, {1}, {0.9}, {1}).factor, 10, 1e-12);
}

TEST(Relaxation, factors_out_of_range_are_faults) {
  EXPECT_TRUE(faults_of(ConstantRelaxation{2}).empty());
  EXPECT_EQ(faults_of(ConstantRelaxation{2.001}).size(), 1u);
  EXPECT_EQ(faults_of(ConstantRelaxation{0}).at(0).key, "coupling.relaxation_factor");
  EXPECT_EQ(faults_of(AitkenRelaxation{1, 1.5, 3}).size(), 1u);
}

TEST(Convergence, a_cluster_of_knots_counts_as_one) {
  const std::vector<double> weights =
      knot_weights({{0.4, {1, 100, 100.0001}, {3, 2, 2}}, {0.5, {7}, {1}}});
  ASSERT_EQ(weights.size(), 4u);
  EXPECT_NEAR(weights[0], 0.5, 1e-6);
  EXPECT_NEAR(weights[1] + weights[2], 0.5, 1e-6);
  EXPECT_EQ(weights[3], 1);
  EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 2, 1e-14);
  EXPECT_DOUBLE_EQ(weighted_rms({1, -3}, {3, 1}), std::sqrt(12.0 / 4));
}

std::vector<double> geometric(double first, double ratio, int count) {
  std::vector<double> changes{first};
  while (std::ssize(changes) < count) changes.push_back(changes.back() * ratio);
  return changes;
}

TEST(Divergence, a_long_rise_is_reported_and_a_fall_is_not) {
  const DivergenceLimits limits;
  EXPECT_NO_THROW(require_no_divergence(geometric(0.2, 1.2, 5), limits, 1));
  EXPECT_THROW(require_no_divergence(geometric(0.2, 1.2, 6), limits, 1), NumericalError);
  EXPECT_NO_THROW(require_no_divergence(geometric(0.2, 0.99, 50), limits, 1));
}

TEST(Divergence, a_rise_that_stays_small_or_slow_or_is_broken_is_none) {
  const DivergenceLimits limits;
  EXPECT_NO_THROW(require_no_divergence(geometric(1e-4, 1.2, 8), limits, 1));
  EXPECT_NO_THROW(require_no_divergence(geometric(0.2, 1.1, 6), limits, 1));
  std::vector<double> broken = geometric(0.2, 1.5, 8);
  broken[5] = 0.1;
  EXPECT_NO_THROW(require_no_divergence(broken, limits, 1));
}

TEST(Divergence, huge_or_not_finite_is_reported_at_once_with_the_values) {
  EXPECT_THROW(require_no_divergence({51}, {}, 1), NumericalError);
  EXPECT_NO_THROW(require_no_divergence({49}, {}, 1));
  try {
    require_no_divergence({0.5, std::nan("")}, {}, 0.75);
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("pass 2"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("0.75"));
  }
}

std::vector<ShearForcing> flows(std::initializer_list<double> rates) {
  std::vector<ShearForcing> result;
  for (const double rate : rates) result.push_back(simple_shear(rate, 0.4));
  return result;
}

TEST(ShearGroups, near_rates_share_a_run_of_the_lowest_slot_at_their_mean) {
  const ShearGroups groups = group_by_shear_rate(flows({104, 50, 100}), 1.05, 1);
  ASSERT_EQ(groups.runs.size(), 2u);
  EXPECT_EQ(groups.runs[0].slot, 1);
  EXPECT_EQ(groups.runs[0].flow.shear_rate, 50);
  EXPECT_EQ(groups.runs[1].slot, 0);
  EXPECT_NEAR(groups.runs[1].flow.shear_rate, std::sqrt(104.0 * 100), 1e-10);
  EXPECT_EQ(groups.runs[1].flow.forcing.velocity_gradient(0, 1), groups.runs[1].flow.shear_rate);
}

TEST(ShearGroups, a_chain_of_near_rates_does_not_grow_beyond_the_ratio) {
  EXPECT_EQ(group_by_shear_rate(flows({100, 104, 108, 112}), 1.05, 1).runs.size(), 2u);
}

TEST(ShearGroups, low_rates_are_left_out_and_counted_on_both_sides_of_the_limit) {
  const ShearGroups groups = group_by_shear_rate(flows({0, 0.999, 1, 5}), 1.05, 1);
  EXPECT_EQ(groups.points_below_lowest, 2);
  EXPECT_EQ(groups.runs.size(), 2u);
}

TEST(ShearGroups, different_hematocrits_are_never_shared) {
  std::vector<ShearForcing> two = flows({100, 100});
  two[1].forcing.hematocrit = 0.41;
  EXPECT_EQ(group_by_shear_rate(two, 1.05, 1).runs.size(), 2u);
}

RheologySample sample(double rate, double relative_error, bool precise) {
  RheologySample s;
  s.shear_rate = rate;
  s.hematocrit = 0.4;
  s.viscosity = 2;
  s.viscosity_error = 2 * relative_error;
  s.precision_reached = precise;
  return s;
}

TEST(Covered, by_a_precise_sample_within_the_ratio) {
  const std::vector<RheologySample> samples = {sample(100, 0.02, true)};
  EXPECT_TRUE(is_covered(simple_shear(104.9, 0.4), samples, 1.05, 0.02));
  EXPECT_TRUE(is_covered(simple_shear(95.3, 0.4), samples, 1.05, 0.02));
  EXPECT_FALSE(is_covered(simple_shear(105.1, 0.4), samples, 1.05, 0.02));
  EXPECT_FALSE(is_covered(simple_shear(95.2, 0.4), samples, 1.05, 0.02));
  EXPECT_FALSE(is_covered(simple_shear(100, 0.41), samples, 1.05, 0.02));
}

TEST(Covered, by_several_samples_that_are_precise_together) {
  std::vector<RheologySample> samples = {sample(100, 0.03, false), sample(101, 0.03, false)};
  EXPECT_FALSE(is_covered(simple_shear(100, 0.4), samples, 1.05, 0.02));
  samples.push_back(sample(99, 0.03, false));
  EXPECT_TRUE(is_covered(simple_shear(100, 0.4), samples, 1.05, 0.02));
}

TEST(SpreadOverRanks, slow_runs_go_first_to_the_least_loaded_rank) {
  std::vector<PlannedRun> plan;
  for (const double rate : {1.0, 2.0, 4.0, 4.0}) plan.push_back({0, simple_shear(rate, 0.4)});
  EXPECT_THAT(spread_over_ranks(plan, 1), ElementsAre(0, 0, 0, 0));
  EXPECT_THAT(spread_over_ranks(plan, 2), ElementsAre(0, 1, 1, 1));
  EXPECT_THAT(spread_over_ranks(plan, 3), ElementsAre(0, 1, 2, 2));
}

TEST(ByteStream, keeps_every_bit) {
  micro::Observation<2> sent;
  sent.shear_rate = 0.1 + 0.2;
  sent.hematocrit = -0.0;
  sent.shear_stress = {1, 2, std::numeric_limits<double>::infinity(), 4};
  sent.first_normal_difference = {5, 6, 7, std::numeric_limits<double>::denorm_min()};
  sent.particle_stress << 1, 2, 3, 4;
  sent.averaging_time = 8;
  sent.warm_up_time = 9;
  sent.steps = std::int64_t{1} << 60;
  sent.termination = micro::Termination::precision_reached;
  sent.ledger = {{"area of the worst cell", 1e-9, 1e-6, 1e-3}};
  micro::Snapshot state;
  state.reals["x"] = {1, 2};
  state.reals["none"] = {};
  state.integers["n"] = {-7};

  ByteWriter writer;
  writer.observation(sent);
  writer.snapshot(state);
  ByteReader reader(writer.bytes());
  const micro::Observation<2> received = reader.observation();
  const micro::Snapshot copy = reader.snapshot();
  EXPECT_TRUE(reader.at_end());
  ByteWriter again;
  again.observation(received);
  again.snapshot(copy);
  EXPECT_EQ(again.bytes(), writer.bytes());
  EXPECT_EQ(received.shear_rate, sent.shear_rate);
  EXPECT_TRUE(std::signbit(received.hematocrit));
  EXPECT_EQ(received.shear_stress.correlation_time, sent.shear_stress.correlation_time);
  EXPECT_EQ(received.first_normal_difference.effective_samples,
            sent.first_normal_difference.effective_samples);
  EXPECT_EQ(received.averaging_time, 8);
  EXPECT_EQ(received.warm_up_time, 9);
  EXPECT_EQ(received.termination, micro::Termination::precision_reached);
  EXPECT_EQ(received.ledger.at(0).stop_above, 1e-3);
  EXPECT_EQ(received.steps, sent.steps);
  EXPECT_EQ(received.ledger.at(0).name, "area of the worst cell");
  EXPECT_EQ(received.particle_stress, sent.particle_stress);
  EXPECT_EQ(copy.integers.at("n").at(0), -7);
  EXPECT_THROW(reader.real(), std::logic_error);
}

}  // namespace
}  // namespace hemoscale::coupling
