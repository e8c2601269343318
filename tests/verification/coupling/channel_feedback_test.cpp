#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "coupling/sampling/sample_points.hpp"
#include "coupling/scheme/coupling_scheme.hpp"
#include "macro/analytic/channel_model.hpp"
#include "tests/support/coupling_doubles.hpp"

namespace hemoscale::coupling {
namespace {

constexpr double hematocrit = 0.4;
constexpr double height = 100e-6;  // [m]

macro::ChannelModel<2> channel(double wall_stress) {
  macro::Channel parameters;
  parameters.height = height;
  parameters.hematocrit = hematocrit;
  parameters.drive = macro::PressureGradient{2 * wall_stress / height};
  return macro::ChannelModel<2>(parameters);
}

CoupledFlow<2> at_the_wall(macro::MacroModel<2>& model) {
  return {model, points_across<2>({0, height / 2}, {0, 0}, 1, 0.5), hematocrit};
}

CoupledFlow<2> across(macro::MacroModel<2>& model, int count) {
  return {model, points_across<2>({0, height / 2}, {0, 0}, count, 0.1), hematocrit};
}

LoopOptions exact_options() {
  LoopOptions options = testing::loop_options(testing::exact_run());
  options.bounds.shear_thinning = false;
  options.memory = Memory::latest;
  options.tolerance = 1e-6;
  return options;
}

// Fixed pressure gradient, one sample point, no memory: the law is one viscosity, and its logarithm
// obeys e(n+1) = (1 - factor n) e(n) with n the index of the power law.
double contraction(double index, double factor) {
  const micro::Communicator alone;
  LoopOptions options = exact_options();
  options.relaxation = ConstantRelaxation{factor};
  const macro::ViscosityLaw truth = testing::power_law(0.01, index);
  auto model = channel(truth.viscosity(100, hematocrit) * 100);
  CoupledFlow<2> flow = at_the_wall(model);
  CoupledLoop loop(testing::newtonian(1.5 * truth.viscosity(100, hematocrit)), options,
                   testing::synthetic(truth, 0, 1), alone);
  Explicit<2> scheme;
  std::vector<double> changes;
  for (int pass = 0; pass < 4; ++pass) {
    changes.push_back(scheme.advance(flow, loop, {}, {}).passes.at(0).change);
  }
  return changes[3] / changes[2];
}

TEST(Feedback, contraction_factor_is_one_minus_relaxation_times_index) {
  for (const double index : {0.3, 1.0, 1.6, 2.5}) {
    for (const double factor : {0.2, 0.5, 0.72, 0.88}) {
      const double expected = std::abs(1 - factor * index);
      if (expected < 0.05) continue;  // too close to a factor that solves in one pass
      EXPECT_NEAR(contraction(index, factor) / expected, 1, 0.01) << index << " " << factor;
    }
  }
}

int passes_to_converge(const Relaxation& relaxation) {
  const micro::Communicator alone;
  LoopOptions options = exact_options();
  options.relaxation = relaxation;
  const macro::ViscosityLaw truth = testing::power_law(0.5, 0.3);
  auto model = channel(truth.viscosity(100, hematocrit) * 100);
  CoupledFlow<2> flow = at_the_wall(model);
  CoupledLoop loop(testing::newtonian(3.5e-3), options, testing::synthetic(truth, 0, 1), alone);
  Implicit<2> scheme(200);
  const WindowReport<2> window = scheme.advance(flow, loop, {}, {});
  EXPECT_TRUE(window.converged);
  EXPECT_NEAR(loop.law().viscosity(1, hematocrit) / truth.viscosity(100, hematocrit), 1, 5e-6);
  return static_cast<int>(window.passes.size());
}

TEST(Feedback, aitken_converges_in_few_passes_where_the_plain_iteration_needs_many) {
  const int plain = passes_to_converge(ConstantRelaxation{1});
  const int aitken = passes_to_converge(AitkenRelaxation{});
  RecordProperty("plain", plain);
  RecordProperty("aitken", aitken);
  EXPECT_LE(aitken, 8);
  EXPECT_GE(plain, 30);
  EXPECT_LE(plain, 50);
}

// The whole loop on a thinning law: the flow under the law that was found is the flow under the law
// that the micro models follow.
TEST(Feedback, flow_under_the_recovered_law_is_that_under_the_true_law) {
  const micro::Communicator alone;
  for (const Memory memory : {Memory::accumulate, Memory::latest}) {
    LoopOptions options = testing::loop_options(testing::exact_run());
    options.memory = memory;
    options.tolerance = 1e-3;
    auto model = channel(1.0);
    CoupledFlow<2> flow = across(model, 6);
    CoupledLoop loop(testing::newtonian(3.5e-3), options,
                     testing::synthetic(testing::blood(), 0, 1), alone);
    Implicit<2> scheme(20);
    const WindowReport<2> window = scheme.advance(flow, loop, {}, {});
    EXPECT_TRUE(window.converged);
    EXPECT_LE(window.passes.size(), 8u);
    RecordProperty(memory == Memory::latest ? "passes_latest" : "passes_accumulate",
                   static_cast<int>(window.passes.size()));
    const auto truth = model.solve(testing::blood());
    const double scale = truth->velocity(height / 2);
    for (double y = 0; y < height; y += height / 50) {
      EXPECT_NEAR(window.field->at({0, y}, 0)->velocity[0], truth->velocity(y), 5e-3 * scale);
    }
  }
}

TEST(Feedback, noise_limits_what_convergence_demands_and_the_report_says_so) {
  const micro::Communicator alone;
  LoopOptions options = testing::loop_options(testing::short_run());
  options.tolerance = 1e-5;  // far below the error of the samples
  auto model = channel(1.0);
  CoupledFlow<2> flow = across(model, 6);
  CoupledLoop loop(testing::newtonian(3.5e-3), options,
                   testing::synthetic(testing::blood(), 0.05, 3), alone);
  Implicit<2> scheme(30);
  const WindowReport<2> window = scheme.advance(flow, loop, {}, {});
  ASSERT_TRUE(window.converged);
  const LoopReport& last = window.passes.back();
  EXPECT_LE(window.passes.size(), 10u);
  EXPECT_GT(last.change, options.tolerance);
  EXPECT_LE(last.change, last.noise);
  EXPECT_TRUE(last.limited_by_noise);
  // The law is right within its own band, though the tolerance asks for more.
  const RheologyTable& table = *loop.candidate();
  for (const double rate : table.rows().at(0).shear_rates) {
    EXPECT_LE(std::abs(std::log(loop.law().viscosity(rate, hematocrit) /
                                testing::blood().viscosity(rate, hematocrit))),
              table.log_half_width(rate, hematocrit));
  }
}

TEST(Feedback, without_the_allowance_for_noise_new_samples_never_settle) {
  const micro::Communicator alone;
  LoopOptions options = testing::loop_options(testing::short_run());
  options.tolerance = 1e-5;
  options.stop_at_noise = false;
  options.memory = Memory::latest;
  auto model = channel(1.0);
  CoupledFlow<2> flow = across(model, 6);
  CoupledLoop loop(testing::newtonian(3.5e-3), options,
                   testing::synthetic(testing::blood(), 0.05, 3), alone);
  const WindowReport<2> window = Implicit<2>(12).advance(flow, loop, {}, {});
  EXPECT_FALSE(window.converged);
  EXPECT_EQ(window.passes.size(), 12u);
  for (const LoopReport& report : window.passes) EXPECT_FALSE(report.limited_by_noise);
}

// With memory the micro runs become fewer from pass to pass, and none is needed in the end.
TEST(Feedback, memory_saves_micro_runs) {
  const micro::Communicator alone;
  LoopOptions options = testing::loop_options(testing::short_run());
  auto model = channel(1.0);
  CoupledFlow<2> flow = across(model, 6);
  CoupledLoop loop(testing::newtonian(3.5e-3), options,
                   testing::synthetic(testing::blood(), 0.05, 5), alone);
  Explicit<2> scheme;
  std::vector<int> runs;
  for (int pass = 0; pass < 6; ++pass) {
    const LoopReport report = scheme.advance(flow, loop, {}, {}).passes.at(0);
    EXPECT_EQ(report.micro_runs + report.shear_rates_covered, 6);
    runs.push_back(report.micro_runs);
  }
  EXPECT_EQ(runs.front(), 6);
  EXPECT_EQ(runs.back(), 0);
}

TEST(Feedback, one_way_measures_and_leaves_the_law) {
  const micro::Communicator alone;
  auto model = channel(1.0);
  CoupledFlow<2> flow = across(model, 4);
  CoupledLoop loop(testing::newtonian(3.5e-3), testing::loop_options(testing::exact_run()),
                   testing::synthetic(testing::blood(), 0, 1), alone);
  const WindowReport<2> window = OneWay<2>().advance(flow, loop, {}, {});
  ASSERT_EQ(window.passes.size(), 1u);
  EXPECT_EQ(window.passes[0].relaxation_factor, 0);
  EXPECT_EQ(window.passes[0].micro_runs, 4);
  EXPECT_GT(window.passes[0].change, 0.1);
  EXPECT_EQ(loop.law().name(), "newtonian");
  const double wall_rate = 1.0 / 3.5e-3;
  EXPECT_NEAR(loop.candidate()->law().viscosity(wall_rate, hematocrit),
              testing::blood().viscosity(wall_rate, hematocrit), 1e-8);
}

}  // namespace
}  // namespace hemoscale::coupling
