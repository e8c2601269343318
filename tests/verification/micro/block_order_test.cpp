#include <gtest/gtest.h>

#include "tests/support/micro/block_runs.hpp"

// Convergence of the integrators in time, with explicit steps in double precision as the reference.
namespace hemoscale::micro {
namespace {

using test::BlockCase;
using test::Integrator;

std::vector<EnsembleState> after(BlockCase c, Integrator integrator, double duration,
                                 std::int64_t steps) {
  test::set_integrator(c.settings, integrator);
  c.settings.time_step = duration / static_cast<double>(steps);
  BlockEnsemble ensemble = c.make(Precision::twofold);
  ensemble.advance(steps);
  return ensemble.states();
}

/// Eight cells in a channel of 20 um, without contacts at 3 um/s: the flow turns and bends them.
BlockCase slow_channel(double speed) {
  BlockCase c =
      test::crowded_channel({.columns = 2, .rows = 4, .spacing_x = 9e-6, .spacing_y = 4.2e-6});
  c.settings.kinds.pop_back();
  c.initial.pop_back();
  c.settings.height = 20e-6;
  c.settings.flow = test::parabola(20e-6, speed);
  return c;
}

std::vector<double> errors(const BlockCase& c, Integrator integrator, double duration,
                           const std::vector<EnsembleState>& reference,
                           const std::vector<std::int64_t>& steps) {
  std::vector<double> found;
  for (const std::int64_t n : steps) {
    found.push_back(test::node_difference(after(c, integrator, duration, n), reference));
  }
  return found;
}

double order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

TEST(BlockOrder, of_the_implicit_integrators_without_contacts) {
  constexpr double duration = 0.4;
  const BlockCase c = slow_channel(3e-6);
  const auto reference = after(c, Integrator::explicit_euler, duration, 1000000);
  ASSERT_EQ(test::count_contacts(reference, 0.5e-6), 0U);
  const auto first = errors(c, Integrator::linearly_implicit, duration, reference, {100, 200, 400});
  EXPECT_NEAR(order(first[0], first[1]), 1, 0.1);
  EXPECT_NEAR(order(first[1], first[2]), 1, 0.1);
  EXPECT_LT(first[2], 1e-10) << "1e-4 um at 1 ms";
  const auto constant =
      errors(c, Integrator::constant_operator, duration, reference, {100, 200, 400});
  EXPECT_LT(constant[2], 1e-10);
  const auto second =
      errors(c, Integrator::constant_operator_second_order, duration, reference, {100, 200, 400});
  EXPECT_LT(second[2], 1e-10);
}

TEST(BlockOrder, of_the_implicit_integrator_with_contacts) {
  constexpr double duration = 0.25;
  const BlockCase c = test::shear_box(6, {.columns = 2, .rows = 4, .spacing_y = 2.7e-6});
  const auto reference = after(c, Integrator::explicit_euler, duration, 625000);
  ASSERT_GT(test::count_contacts(reference, 0.3e-6), 20U);
  const auto found =
      errors(c, Integrator::linearly_implicit, duration, reference, {1250, 2500, 5000});
  EXPECT_NEAR(order(found[0], found[1]), 1, 0.1);
  EXPECT_NEAR(order(found[1], found[2]), 1, 0.1);
}

TEST(BlockOrder, of_the_explicit_integrators_with_contacts) {
  constexpr double duration = 0.02;
  BlockCase c = test::shear_box(60, {.columns = 2, .rows = 4});
  const auto reference = after(c, Integrator::explicit_euler, duration, 800000);
  const auto found =
      errors(c, Integrator::explicit_euler, duration, reference, {50000, 100000, 200000});
  // The reference is not exact: orders come out above one by its share of the error.
  EXPECT_NEAR(order(found[0], found[1]), std::log2((16.0 - 1) / (8 - 1)), 0.1);
  EXPECT_NEAR(order(found[1], found[2]), std::log2((8.0 - 1) / (4 - 1)), 0.1);
}

}  // namespace
}  // namespace hemoscale::micro
