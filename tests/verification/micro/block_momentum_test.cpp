#include <gtest/gtest.h>

#include "tests/support/micro/block_runs.hpp"

// Forces of a membrane sum to zero and the flow is along x: with isotropic drag nothing moves the
// mean of the nodes of an isolated cell across the flow.
namespace hemoscale::micro {
namespace {

using test::BlockCase;
using test::Integrator;

constexpr double height = 75e-6;  // [m]

double mean_y(const BlockEnsemble& ensemble) {
  const EnsembleState state = ensemble.states().front();
  double sum = 0;
  for (const double y : state.y) sum += y - state.y.front();
  return state.y.front() + sum / static_cast<double>(state.y.size());
}

/// A cell that relaxes from another shape while the flow turns it.
BlockCase bent_cell(Integrator integrator) {
  BlockCase c = test::lonely_cell_in_channel();
  test::set_integrator(c.settings, integrator);
  EnsembleState& s = c.initial.front();
  const double centre = s.y.front();
  for (std::size_t i = 0; i < s.x.size(); ++i) s.x[i] += 0.2 * (s.y[i] - centre);
  return c;
}

struct DriftCase {
  const char* name;
  Integrator integrator;
  Precision precision;
  double time_step;  // [s]
  std::int64_t steps;
  double allowed;  // [-] drift over the height of the channel
};

void PrintTo(const DriftCase& c, std::ostream* out) {
  *out << c.name;
}

class BlockDrift : public testing::TestWithParam<DriftCase> {};

TEST_P(BlockDrift, across_the_flow_is_round_off) {
  BlockCase c = bent_cell(GetParam().integrator);
  c.settings.time_step = GetParam().time_step;
  BlockEnsemble ensemble = c.make(GetParam().precision);
  const double before = mean_y(ensemble);
  double largest = 0;
  for (int k = 0; k < 20; ++k) {
    ensemble.advance(GetParam().steps / 20);
    largest = std::max(largest, std::abs(mean_y(ensemble) - before) / height);
  }
  EXPECT_LE(largest, GetParam().allowed);
}

INSTANTIATE_TEST_SUITE_P(
    Integrators, BlockDrift,
    testing::Values(DriftCase{"explicit_double", Integrator::explicit_euler, Precision::twofold,
                              4e-7, 100000, 1e-12},
                    DriftCase{"explicit_single", Integrator::explicit_euler, Precision::single,
                              4e-7, 100000, 1e-6},
                    DriftCase{"implicit_double", Integrator::linearly_implicit, Precision::twofold,
                              2e-3, 100000, 1e-12},
                    DriftCase{"implicit_single", Integrator::linearly_implicit, Precision::single,
                              2e-3, 100000, 1e-6},
                    DriftCase{"constant_operator_double", Integrator::constant_operator,
                              Precision::twofold, 2e-3, 100000, 1e-12},
                    DriftCase{"constant_operator_single", Integrator::constant_operator,
                              Precision::single, 2e-3, 100000, 1e-6},
                    DriftCase{"second_order_double", Integrator::constant_operator_second_order,
                              Precision::twofold, 2e-3, 100000, 1e-12},
                    DriftCase{"inertial_double", Integrator::inertial, Precision::twofold, 4e-7,
                              100000, 1e-12},
                    DriftCase{"chebyshev_double", Integrator::chebyshev, Precision::twofold, 1e-5,
                              20000, 1e-12}),
    [](const auto& each) { return std::string(each.param.name); });

// Frames in double precision: a cell a hundred millimetres down the channel moves as one at its
// beginning.
TEST(BlockTranslation, along_the_channel_changes_round_off_alone) {
  for (const Precision precision : {Precision::single, Precision::twofold}) {
    BlockCase c = bent_cell(Integrator::linearly_implicit);
    BlockEnsemble here = c.make(precision);
    constexpr double far = 0.1;  // [m]
    for (double& x : c.initial.front().x) x += far;
    BlockEnsemble there = c.make(precision);
    here.advance(1000);
    there.advance(1000);
    auto moved = there.states();
    for (double& x : moved.front().x) x -= far;
    const double difference = test::node_difference(here.states(), moved);
    // 1e5 um in double precision are known to 1.5e-11 um, and each of the thousand steps rounds by
    // half of it at most.
    EXPECT_LE(difference, precision == Precision::single ? 5e-12 : 7.5e-15);
  }
}

}  // namespace
}  // namespace hemoscale::micro
