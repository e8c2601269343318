#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/micro/block_laws.hpp"

// Observed orders of the integrators of the block ensemble on one cell that relaxes in strong
// shear, against explicit steps so small that their own error does not count.
namespace hemoscale::micro {
namespace {

using test::BlockCase;
using test::Integrator;

constexpr double duration = 2e-3;  // [s]: a strain of 0.6, longer than shapes take to relax

/// Positions after the duration.
std::vector<EnsembleState> end_of(BlockCase c, std::int64_t steps) {
  c.settings.time_step = duration / static_cast<double>(steps);
  BlockEnsemble ensemble = c.make(Precision::twofold);
  ensemble.advance(steps);
  return ensemble.states();
}

/// Two runs extrapolated to steps of zero length.
std::vector<EnsembleState> extrapolated(const BlockCase& c, std::int64_t steps, int order) {
  const auto coarse = end_of(c, steps);
  auto fine = end_of(c, 2 * steps);
  const double weight = 1 / (std::pow(2.0, order) - 1);
  for (std::size_t i = 0; i < fine.front().x.size(); ++i) {
    fine.front().x[i] += weight * (fine.front().x[i] - coarse.front().x[i]);
    fine.front().y[i] += weight * (fine.front().y[i] - coarse.front().y[i]);
  }
  return fine;
}

struct OrderCase {
  const char* name;
  Integrator integrator;
  std::int64_t steps;  // of the coarsest run
  double order;
  double largest_error;  // [m] of the coarsest run: it is in the range of the method
};

void PrintTo(const OrderCase& c, std::ostream* out) {
  *out << c.name;
}

class BlockOrders : public testing::TestWithParam<OrderCase> {};

TEST_P(BlockOrders, are_as_promised) {
  const OrderCase& c = GetParam();
  BlockCase run = test::relaxing_cell();
  run.settings.integrator = Integrator::explicit_euler;
  const auto wanted = extrapolated(run, 20000, 1);
  run.settings.integrator = c.integrator;
  std::vector<double> errors;
  for (int k = 0; k < 3; ++k) {
    errors.push_back(test::node_difference(end_of(run, c.steps << k), wanted));
  }
  const double order = 0.5 * std::log2(errors[0] / errors[2]);
  RecordProperty("order", std::to_string(order));
  EXPECT_NEAR(order, c.order, 0.2) << errors[0] << " " << errors[1] << " " << errors[2] << " m";
  EXPECT_LT(errors[0], c.largest_error);
}

INSTANTIATE_TEST_SUITE_P(
    Integrators, BlockOrders,
    testing::Values(OrderCase{"explicit_euler", Integrator::explicit_euler, 200, 1, 1e-7},
                    OrderCase{"linearly_implicit", Integrator::linearly_implicit, 100, 1, 1e-7},
                    OrderCase{"constant_operator", Integrator::constant_operator, 100, 1, 1e-7},
                    OrderCase{"constant_operator_second_order",
                              Integrator::constant_operator_second_order, 100, 2, 1e-7},
                    OrderCase{"chebyshev", Integrator::chebyshev, 40, 2, 1e-8}),
    [](const auto& each) { return std::string(each.param.name); });

// With mass there is no overdamped reference but itself; the velocity at the beginning is that of
// the step, so that first order would show.
TEST(BlockOrdersWithMass, are_second_for_viscous_and_first_for_momentum_drag) {
  for (const double momentum : {0.0, 2e-2}) {
    BlockCase run = test::relaxing_cell();
    run.settings.integrator = Integrator::inertial;
    run.settings.kinds.front().node_mass = 0.2e-3 * run.settings.kinds.front().node_drag;
    run.settings.kinds.front().momentum_drag = momentum;
    const auto wanted = extrapolated(run, 6400, momentum > 0 ? 1 : 2);
    std::vector<double> errors;
    for (const std::int64_t steps : {200, 400, 800}) {
      errors.push_back(test::node_difference(end_of(run, steps), wanted));
    }
    const double order = 0.5 * std::log2(errors[0] / errors[2]);
    RecordProperty(momentum > 0 ? "order_momentum" : "order", std::to_string(order));
    EXPECT_NEAR(order, momentum > 0 ? 1 : 2, 0.25)
        << "momentum drag " << momentum << ": " << errors[0] << " " << errors[1] << " "
        << errors[2];
  }
}

// A node that is dropped into a uniform stream: v = u (1 - exp(-t zeta/m)), exact for any step, and
// with the momentum drag v' = (zeta + k |u - v|)(u - v)/m, solved by partial fractions.
TEST(BlockMass, velocities_approach_that_of_the_flow_as_they_must) {
  BlockCase run = test::relaxing_cell();
  auto& kind = run.settings.kinds.front();
  run.settings.integrator = Integrator::inertial;
  run.settings.time_step = 2e-6;
  kind.node_mass = 1e-4 * kind.node_drag;
  const double limit = 4e-3;  // [m/s] of the flow
  for (const double momentum : {0.0, 0.5 * kind.node_drag / limit}) {
    kind.momentum_drag = momentum;
    run.settings.flow = std::make_shared<test::Gust>(limit, 10e-6);
    BlockEnsemble ensemble = run.make(Precision::twofold);
    ensemble.advance(5);  // the gust begins
    const auto mean = [&] {
      const auto state = ensemble.states().front();
      double sum = 0;
      for (const double x : state.x) sum += x;
      return sum / static_cast<double>(state.x.size());
    };
    for (int k = 0; k < 4; ++k) {
      ensemble.advance(20);
      const double before = mean();
      ensemble.advance(1);
      const double velocity = (mean() - before) / run.settings.time_step;
      // Half a step before the end, as velocities belong to the middles of steps.
      const double t = ensemble.time() - 10e-6;
      const double decay = std::exp(-t * kind.node_drag / kind.node_mass);
      const double slip = limit * decay / (1 + momentum * limit / kind.node_drag * (1 - decay));
      EXPECT_NEAR(velocity, limit - slip, 0.02 * limit) << "momentum drag " << momentum;
    }
  }
}

// In single precision the explicit integrators remember what rounding drops.
TEST(BlockOrders, single_precision_agrees_with_double) {
  for (const Integrator integrator : {Integrator::explicit_euler, Integrator::chebyshev}) {
    BlockCase run = test::relaxing_cell();
    run.settings.integrator = integrator;
    run.settings.time_step = integrator == Integrator::chebyshev ? 2e-5 : 2e-7;
    const auto steps = static_cast<std::int64_t>(std::lround(duration / run.settings.time_step));
    BlockEnsemble single = run.make(Precision::single);
    BlockEnsemble twofold = run.make(Precision::twofold);
    single.advance(steps);
    twofold.advance(steps);
    EXPECT_LT(test::node_difference(single.states(), twofold.states()), 2e-11);
  }
}

}  // namespace
}  // namespace hemoscale::micro
