#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/support/immersed/parachutes.hpp"

// All reference cells, and what spacing, nodes and steps cost in accuracy. Prints its tables.
namespace hemoscale::micro {
namespace {

using namespace test;

class AllParachutes : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(, AllParachutes, testing::Values(60, 118));

TEST_P(AllParachutes, are_those_of_the_reference) {
  for (std::size_t row = 0; row < 5; ++row) {
    const ParachuteCase c = parachute_case(row);
    const Parachute p = run_parachute(c, {.nodes = GetParam(),
                                          .travel = (c.mean_speed > 5e-3 ? 300 : 120) * micron,
                                          .is_relaxed = true});
    std::printf("row %zu, %d nodes: %s\n  reference: %s\n", row, GetParam(), described(p).c_str(),
                described(c.known).c_str());
    EXPECT_NEAR(p.speed, c.known.speed, 0.005 * c.known.speed) << row;
    EXPECT_NEAR(p.drop, c.known.drop, 0.03 * c.known.drop) << row;
    EXPECT_NEAR(p.gap, c.known.gap, 0.03 * c.known.gap) << row;
    EXPECT_LT(p.shape_distance, 0.05 * micron) << row;
    EXPECT_LT(std::abs(p.length - c.known.length), 0.05 * micron) << row;
    EXPECT_LT(std::abs(p.dimple - c.known.dimple), 0.05 * micron) << row;
    EXPECT_GT(p.speed_settled, 0) << row;
    EXPECT_NEAR(p.speed_settled, c.known.speed_settled, 0.1 * c.known.speed_settled) << row;
    EXPECT_NEAR(p.length_settled, c.known.length_settled, 0.1 * c.known.length_settled) << row;
  }
}

/// Three figures with the error of the finest by Richardson's extrapolation at their own order.
void print_limit(const char* what, double coarse, double middle, double fine) {
  const double order = std::log2(std::abs((coarse - middle) / (middle - fine)));
  const double left = (middle - fine) / (std::exp2(order) - 1);
  std::printf("  %s: order %.2f, limit %.6g, left at the finest %.2e\n", what, order, fine - left,
              std::abs(left / fine));
}

using Change = std::function<void(ParachuteRun&, int level)>;

std::vector<Parachute> refine(const char* what, const Change& change) {
  std::printf("%s\n", what);
  std::vector<Parachute> levels;
  for (int level = 0; level < 3; ++level) {
    ParachuteRun run{.nodes = 59, .travel = 60 * micron};
    run.options.sweep_tolerance = 1e-6;
    change(run, level);
    levels.push_back(run_parachute(parachute_case(1), run));
    std::printf("  %d: %s\n", level, described(levels.back()).c_str());
  }
  print_limit("V/U", levels[0].speed, levels[1].speed, levels[2].speed);
  print_limit("length", levels[0].length, levels[1].length, levels[2].length);
  print_limit("dP", levels[0].drop, levels[1].drop, levels[2].drop);
  return levels;
}

TEST(ParachuteConvergence, with_the_spacing_of_the_plasma) {
  const std::vector<Parachute> p = refine("l0 = 1, 0.5, 0.25 um", [](ParachuteRun& run, int level) {
    run.spacing = std::exp2(-level) * micron;
  });
  EXPECT_LT(std::abs(p[1].speed - p[2].speed), std::abs(p[0].speed - p[1].speed));
  EXPECT_LT(std::abs(p[1].speed - p[2].speed), 1e-3);
  EXPECT_LT(std::abs(p[1].drop / p[2].drop - 1), 0.01);
}

TEST(ParachuteConvergence, with_the_nodes_of_the_membrane_is_of_second_order) {
  const std::vector<Parachute> p =
      refine("30, 60, 120 nodes", [](ParachuteRun& run, int level) { run.nodes = 30 << level; });
  EXPECT_NEAR(halving_order(p[0].speed, p[1].speed, p[2].speed), 2, 0.3);
  EXPECT_NEAR(halving_order(p[0].length, p[1].length, p[2].length), 2, 0.3);
}

TEST(ParachuteConvergence, with_the_steps_is_of_second_order_on_the_way) {
  // Steady cells do not show the step: half way to steadiness.
  const std::vector<Parachute> p =
      refine("dt = 50, 25, 12.5 us, after 5 um", [](ParachuteRun& run, int level) {
        run.travel = 5 * micron;
        run.options.longest_step = 5e-5 * std::exp2(-level);
        run.options.step_tolerance = 0;
        run.options.sweep_tolerance = 1e-8;
      });
  EXPECT_NEAR(halving_order(p[0].speed, p[1].speed, p[2].speed), 2, 0.5);
  const std::vector<Parachute> t =
      refine("tolerance 1e-2, 1e-3, 1e-4, after 5 um", [](ParachuteRun& run, int level) {
        run.travel = 5 * micron;
        run.options.longest_step = 1e-3;
        run.options.step_tolerance = std::pow(10, -2 - level);
      });
  EXPECT_LT(std::abs(t[1].speed - p[2].speed), 0.5 * std::abs(t[0].speed - p[2].speed) + 1e-6);
}

}  // namespace
}  // namespace hemoscale::micro
