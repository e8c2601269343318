#include "coupling/scheme/coupled_loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "coupling/error.hpp"
#include "coupling/sampling/sample_points.hpp"
#include "coupling/scheme/coupling_scheme.hpp"
#include "micro/error.hpp"
#include "tests/support/coupling_doubles.hpp"

namespace hemoscale::coupling {
namespace {

using ::testing::UnorderedElementsAre;

constexpr double hematocrit = 0.4;

std::vector<ShearForcing> flows(std::initializer_list<double> rates) {
  std::vector<ShearForcing> result;
  for (const double rate : rates) result.push_back(simple_shear(rate, hematocrit));
  return result;
}

class Loop : public ::testing::Test {
 protected:
  CoupledLoop make(double noise = 0) {
    return CoupledLoop(testing::newtonian(0.01), options_,
                       testing::synthetic(testing::blood(), noise, 5), alone_);
  }
  static double truth(double rate) { return testing::blood().viscosity(rate, hematocrit); }

  LoopOptions options_ = testing::loop_options(testing::short_run());
  micro::Communicator alone_;
};

TEST_F(Loop, relaxation_acts_on_the_logarithm_at_the_knots_of_the_candidate) {
  options_.relaxation = ConstantRelaxation{0.25};
  CoupledLoop loop = make();
  loop.pass(flows({10, 100}));
  for (const double rate : {10.0, 100.0}) {
    EXPECT_NEAR(loop.law().viscosity(rate, hematocrit),
                std::pow(0.01, 0.75) * std::pow(truth(rate), 0.25), 1e-12);
  }
}

TEST_F(Loop, report_counts_what_was_left_out_held_and_moved) {
  options_.lowest_shear_rate = 5;
  options_.bounds.highest_viscosity = 0.9 * truth(10);
  CoupledLoop loop = make();
  std::vector<ShearForcing> sampled = flows({0, 4, 10, 100, 101});
  sampled[0].flow_type = 0.9;  // not run, so it does not count
  sampled[3].flow_type = -0.2;
  sampled[4].flow_type = 0.1;
  const LoopReport report = loop.pass(sampled);
  EXPECT_EQ(report.pass, 1);
  EXPECT_EQ(report.points_below_lowest_shear_rate, 2);
  EXPECT_EQ(report.micro_runs, 2);
  EXPECT_EQ(report.worst_flow_type, -0.2);
  EXPECT_EQ(report.knots_moved_by_bounds, 1);
  EXPECT_DOUBLE_EQ(report.highest_viscosity, 0.9 * truth(10));
  EXPECT_DOUBLE_EQ(report.lowest_viscosity, truth(std::sqrt(100 * 101.0)));
  EXPECT_EQ(report.samples.size(), 2u);
  EXPECT_EQ(report.runs[1].slot, 3);
}

TEST_F(Loop, with_memory_covered_rates_are_not_run_again) {
  CoupledLoop loop = make(0.05);
  loop.pass(flows({10, 100}));
  const LoopReport report = loop.pass(flows({10.3, 130}));
  EXPECT_EQ(report.micro_runs, 1);
  EXPECT_EQ(report.shear_rates_covered, 1);
  EXPECT_EQ(loop.samples().size(), 3u);
}

TEST_F(Loop, without_memory_the_table_is_that_of_the_last_pass) {
  options_.memory = Memory::latest;
  CoupledLoop loop = make(0.05);
  loop.pass(flows({10, 100}));
  const LoopReport report = loop.pass(flows({10.3, 130}));
  EXPECT_EQ(report.micro_runs, 2);
  EXPECT_EQ(loop.samples().size(), 2u);
}

TEST_F(Loop, runs_that_spend_their_allowance_are_reported_and_repeated) {
  options_.run.minimum_strain = 5;
  options_.run.maximum_strain = 6;
  options_.run.relative_standard_error = 1e-3;
  CoupledLoop loop = make(0.05);
  EXPECT_EQ(loop.pass(flows({10, 100})).runs_without_precision, 2);
  EXPECT_EQ(loop.pass(flows({10, 100})).micro_runs, 2);
  EXPECT_EQ(loop.samples().size(), 4u);
  EXPECT_EQ(loop.candidate()->rows().at(0).shear_rates.size(), 2u);
}

TEST_F(Loop, a_flow_at_rest_leaves_the_law_and_is_not_converged) {
  CoupledLoop loop = make();
  const LoopReport report = loop.pass(flows({0, 0.5}));
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.micro_runs, 0);
  EXPECT_EQ(report.points_below_lowest_shear_rate, 2);
  EXPECT_EQ(loop.law().name(), "newtonian");
  EXPECT_EQ(report.lowest_viscosity, 0.01);
  EXPECT_EQ(report.highest_viscosity, 0.01);
  EXPECT_FALSE(loop.candidate());
  EXPECT_EQ(loop.pass(flows({10, 20})).micro_runs, 2);  // and then it starts to move
}

TEST_F(Loop, converges_once_the_law_is_that_of_the_samples) {
  CoupledLoop loop = make();
  EXPECT_FALSE(loop.pass(flows({10, 100})).converged);
  const LoopReport report = loop.pass(flows({10, 100}));
  EXPECT_TRUE(report.converged);
  EXPECT_TRUE(loop.window_has_converged());
  EXPECT_EQ(report.change, 0);
  loop.end_window();
  EXPECT_FALSE(loop.window_has_converged());
  EXPECT_EQ(loop.passes_in_window(), 0);
  EXPECT_EQ(loop.passes(), 2);
}

TEST_F(Loop, is_unchanged_after_a_failure) {
  bool fails = false;
  const MicroFactory inside = testing::synthetic(testing::blood(), 0.05, 5);
  CoupledLoop loop(
      testing::newtonian(0.01), options_,
      [&](int slot) {
        return std::make_unique<testing::FailingModel>(inside(slot), [&] {
          if (fails) throw micro::NumericalError("unstable");
        });
      },
      alone_);
  loop.pass(flows({10, 100}));
  const micro::Snapshot before = loop.snapshot();
  fails = true;
  EXPECT_THROW(loop.pass(flows({20, 200})), NumericalError);
  EXPECT_EQ(loop.snapshot().reals, before.reals);
  EXPECT_EQ(loop.snapshot().integers, before.integers);
}

TEST_F(Loop, is_unchanged_after_the_iteration_was_found_to_diverge) {
  options_.divergence.largest_change = 0.05;
  CoupledLoop loop = make();
  const micro::Snapshot before = loop.snapshot();
  EXPECT_THROW(loop.pass(flows({10, 100})), NumericalError);
  EXPECT_EQ(loop.snapshot().reals, before.reals);
  EXPECT_EQ(loop.snapshot().integers, before.integers);
}

TEST_F(Loop, all_options_out_of_range_are_named_at_once) {
  options_.relaxation = ConstantRelaxation{3};
  options_.tolerance = 0;
  options_.distinct_ratio = 0.9;
  options_.lowest_shear_rate = 0;
  options_.threads = 0;
  try {
    make();
    FAIL();
  } catch (const CaseError& error) {
    std::vector<std::string> keys;
    for (const Fault& fault : error.faults()) keys.push_back(fault.key);
    EXPECT_THAT(keys, UnorderedElementsAre("coupling.relaxation_factor", "coupling.tolerance",
                                           "sampling.distinct_ratio", "sampling.lowest_shear_rate",
                                           "threads"));
  }
  EXPECT_THROW(Implicit<2>(0), CaseError);
}

TEST_F(Loop, coupled_pass_samples_a_field_in_space) {
  macro::Tensor<3> gradient = macro::Tensor<3>::Zero();
  gradient(1, 2) = 30;
  const testing::UniformGradient<3> field(gradient);
  CoupledLoop loop = make();
  const LoopReport report = coupled_pass<3>(loop, field, {{0, 0, 0}, {0.5, 0, 0}}, 0, hematocrit);
  EXPECT_EQ(report.micro_runs, 1);
  EXPECT_NEAR(loop.law().viscosity(30, hematocrit), truth(30), 1e-10);
  EXPECT_THROW(coupled_pass<3>(loop, field, {{2, 0, 0}}, 0, hematocrit), CaseError);
}

}  // namespace
}  // namespace hemoscale::coupling
