#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "coupling/error.hpp"
#include "coupling/sampling/sample_points.hpp"
#include "coupling/scheme/coupling_scheme.hpp"
#include "macro/analytic/channel_model.hpp"
#include "tests/support/coupling_doubles.hpp"

// At a given pressure gradient a flat law relaxed with the factor w on a power law of index n is
// stable for w < 2 / n. Both sides of the limit.
namespace hemoscale::coupling {
namespace {

constexpr double index = 2.5;
constexpr double limit = 2 / index;
constexpr double height = 1e-4;    // [m]
constexpr double wall_stress = 1;  // [Pa]

struct Iteration {
  std::vector<double> changes;
  bool diverged = false;
};

Iteration iterate(double factor, int passes) {
  const micro::Communicator alone;
  LoopOptions options = testing::loop_options(testing::exact_run());
  options.bounds.shear_thinning = false;
  options.memory = Memory::latest;
  options.relaxation = ConstantRelaxation{factor};
  const macro::ViscosityLaw truth = testing::power_law(1e-5, index);
  macro::Channel parameters;
  parameters.height = height;
  parameters.drive = macro::PressureGradient{2 * wall_stress / height};
  macro::ChannelModel<2> model(parameters);
  CoupledFlow<2> flow{model, points_across<2>({0, height / 2}, {0, 0}, 1, 0.5), 0};
  const double rate = std::pow(wall_stress / 1e-5, 1 / index);  // of the solution
  CoupledLoop loop(testing::newtonian(1.05 * wall_stress / rate), options,
                   testing::synthetic(truth, 0, 1), alone);
  Explicit<2> scheme;
  Iteration result;
  try {
    for (int pass = 0; pass < passes; ++pass) {
      result.changes.push_back(scheme.advance(flow, loop, {}, {}).passes.at(0).change);
    }
  } catch (const NumericalError&) {
    result.diverged = true;
  }
  return result;
}

void expect_factor(const Iteration& iteration, double expected) {
  for (std::size_t i = 3; i < iteration.changes.size(); ++i) {
    if (iteration.changes[i] < 1e-9) break;  // rounding
    EXPECT_NEAR(iteration.changes[i] / iteration.changes[i - 1] / expected, 1, 0.05);
  }
}

TEST(RelaxationLimit, just_below_it_the_iteration_converges) {
  const Iteration iteration = iterate(0.9 * limit, 60);
  EXPECT_FALSE(iteration.diverged);
  EXPECT_LT(iteration.changes.back(), 1e-3 * iteration.changes.front());
  expect_factor(iteration, std::abs(1 - 0.9 * limit * index));
}

TEST(RelaxationLimit, just_above_it_the_iteration_grows_and_is_stopped) {
  const Iteration iteration = iterate(1.1 * limit, 60);
  EXPECT_TRUE(iteration.diverged);
  ASSERT_GE(iteration.changes.size(), 5u);
  EXPECT_LT(iteration.changes.size(), 30u);
  EXPECT_GT(iteration.changes.back(), iteration.changes.front());
  expect_factor(iteration, std::abs(1 - 1.1 * limit * index));
}

}  // namespace
}  // namespace hemoscale::coupling
