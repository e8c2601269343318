#include <gtest/gtest.h>

#include "tests/support/micro/block_runs.hpp"

// The implicit integrators at steps far beyond the explicit limit, whose sides
// block_limits_test.cpp shows.
namespace hemoscale::micro {
namespace {

using test::BlockCase;
using test::Integrator;

/// A lonely cell in a fluid at rest, its nodes displaced at random by a thousandth of a segment.
BlockCase disturbed_cell(Integrator integrator) {
  BlockCase c = test::lonely_cell_in_channel();
  test::set_integrator(c.settings, integrator);
  c.settings.flow = std::make_shared<SimpleShearFlow>(0, 75e-6);
  c.settings.force = true;
  EnsembleState& s = c.initial.front();
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    s.x[i] += 2e-10 * normal({3, 0, i});
    s.y[i] += 2e-10 * normal({3, 1, i});
  }
  return c;
}

/// Motion in one step.
double motion(BlockEnsemble& ensemble) {
  const auto before = ensemble.states();
  ensemble.advance(1);
  return test::node_difference(before, ensemble.states());
}

struct LongCase {
  const char* name;
  Integrator integrator;
};
void PrintTo(const LongCase& c, std::ostream* out) {
  *out << c.name;
}
class BlockLongSteps : public testing::TestWithParam<LongCase> {};

// A thousand times the explicit limit and more: the disturbance dies out in a few steps.
TEST_P(BlockLongSteps, damp_a_disturbance_of_the_membrane) {
  for (const double dt : {1e-3, 1e-2, 0.1}) {
    BlockCase c = disturbed_cell(GetParam().integrator);
    c.settings.time_step = dt;
    BlockEnsemble ensemble = c.make(Precision::twofold);
    const double first = motion(ensemble);
    ensemble.advance(200);
    // Soft modes are slower with the constant operator, which resists them as if they were stiff.
    EXPECT_LT(motion(ensemble), 0.03 * first) << dt;
  }
}

// A cell that has been pushed half into a wall comes out of it and rests.
TEST_P(BlockLongSteps, bear_a_stiff_wall) {
  for (const double dt : {1e-3, 1e-2, 0.1}) {
    BlockCase c = disturbed_cell(GetParam().integrator);
    c.settings.plane_walls = WallPotential{.stiffness = 10, .range = 0.3e-6};
    EnsembleState& s = c.initial.front();
    const double lowest = *std::min_element(s.y.begin(), s.y.end());
    for (double& y : s.y) y -= lowest + 0.2e-6;
    c.settings.time_step = dt;
    BlockEnsemble ensemble = c.make(Precision::twofold);
    ensemble.advance(600);
    const EnsembleState after = ensemble.states().front();
    EXPECT_GT(*std::min_element(after.y.begin(), after.y.end()), 0.2e-6) << dt;
    EXPECT_LT(ensemble.largest_segment_strain(), 0.2) << dt;
  }
}

// Sheared cells in stiff contact at the step of overviews, 1e-3 over the shear rate.
TEST_P(BlockLongSteps, bear_stiff_contacts) {
  BlockCase c = test::shear_box(1);
  test::set_integrator(c.settings, GetParam().integrator);
  c.settings.time_step = 1e-3;
  BlockEnsemble ensemble = c.make(Precision::single);
  ensemble.advance(3000);
  EXPECT_GT(test::count_contacts(ensemble.states(), 0.3e-6), 20U);
  EXPECT_LT(ensemble.largest_segment_strain(), 0.3);
}

INSTANTIATE_TEST_SUITE_P(
    Integrators, BlockLongSteps,
    testing::Values(LongCase{"linearly_implicit", Integrator::linearly_implicit},
                    LongCase{"constant_operator", Integrator::constant_operator},
                    LongCase{"second_order", Integrator::constant_operator_second_order}),
    [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace hemoscale::micro
