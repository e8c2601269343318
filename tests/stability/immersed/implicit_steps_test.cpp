#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "micro/error.hpp"
#include "tests/support/immersed/implicit_runs.hpp"

// Steps of the length that the flow sets, l0 over its largest speed, for membranes of any
// stiffness: no limit of the membrane is left.
namespace hemoscale::micro {
namespace {

using namespace test;

constexpr double speed = 1e-3;
constexpr double spacing = 0.5 * micron;

std::shared_ptr<const Surroundings> capillary(double mean_speed = speed) {
  return kept_channel(24 * micron, 10 * micron, spacing, mean_speed);
}

ImplicitOptions courant_one(double mean_speed = speed) {
  return {.longest_step = spacing / (1.5 * mean_speed), .step_tolerance = 0};
}

CellPlan plan_of(double stretch_modulus) {
  return {.nodes = 59,
          .stretch_modulus = stretch_modulus,
          .bending_modulus = 2e-19,
          .centre = {12 * micron, 5 * micron}};
}

/// 60 um of the mean flow, more of the cell. @returns the run
ImplicitMembranes expect_stable(const CellPlan& plan, double travel = 60 * micron) {
  ImplicitMembranes membranes(capillary(), {deflated_cell(plan)}, courant_one());
  const double from = look_at(membranes).shape.centroid.x();
  membranes.advance_by(travel / speed);
  const Seen seen = look_at(membranes);
  EXPECT_EQ(membranes.counters().refused, 0);
  EXPECT_LE(membranes.counters().steps,
            std::ceil(travel / speed / membranes.options().longest_step) + 1);
  EXPECT_LT(std::abs(seen.strain.area_error), 1e-6);
  EXPECT_LT(std::abs(membranes.leak(0)), 1e-3 * speed);
  EXPECT_GT(seen.shape.centroid.x() - from, travel);
  EXPECT_LT(seen.motion.velocity.x(), 1.5 * speed);
  return membranes;
}

class AnyStretch : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(, AnyStretch,
                         testing::Values(1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0, 0.0),
                         [](const auto& each) {
                           return each.param == 0
                                      ? std::string("inextensible")
                                      : "e" +
                                            std::to_string(std::lround(6 + std::log10(each.param)));
                         });

TEST_P(AnyStretch, is_stable_at_courant_number_one) {
  const ImplicitMembranes membranes = expect_stable(plan_of(GetParam()));
  // With the full Jacobian one factorisation is enough for a sweep.
  EXPECT_LT(static_cast<double>(membranes.counters().factorisations),
            1.1 * static_cast<double>(membranes.counters().sweeps));
  // Stiff ones move as the inextensible one does.
  if (GetParam() == 0 || GetParam() >= 1e-3) {
    EXPECT_NEAR(look_at(membranes).motion.velocity.x() / speed, 1.3111, 5e-4);
    EXPECT_LT(look_at(membranes).strain.length_error, 0.01);
  }
}

class AnyBending : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(, AnyBending, testing::Values(1e-20, 1e-19, 1e-18, 1e-17),
                         [](const auto& each) {
                           return "e" + std::to_string(std::lround(20 + std::log10(each.param)));
                         });

TEST_P(AnyBending, is_stable_at_courant_number_one) {
  CellPlan plan = plan_of(1e-4);
  plan.bending_modulus = GetParam();
  expect_stable(plan);
}

class AnyContrast : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(, AnyContrast, testing::Values(0.1, 5.0, 50.0), [](const auto& each) {
  return "tenths_" + std::to_string(std::lround(10 * each.param));
});

TEST_P(AnyContrast, is_stable_at_courant_number_one) {
  CellPlan plan = plan_of(1e-1);
  plan.viscosity_ratio = GetParam();
  expect_stable(plan);
}

class AnyShape : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(, AnyShape, testing::Values(0.30, 0.46, 0.65, 0.90), [](const auto& each) {
  return "hundredths_" + std::to_string(std::lround(100 * each.param));
});

TEST_P(AnyShape, is_stable_at_courant_number_one) {
  CellPlan plan = plan_of(1e-1);
  plan.reduced_area = GetParam();
  plan.nodes = 60;
  expect_stable(plan);
}

// Beyond a stretch capillary number mu U / E_l of one no steady shape exists: the cell grows longer
// until it does not fit its period, or the strain passes its bound.
TEST(ImplicitStability, membrane_without_steady_shape_ends_in_an_error_that_says_so) {
  ImplicitOptions options = courant_one(0.01);
  options.thresholds.strain = 3;
  ImplicitMembranes membranes(capillary(0.01), {deflated_cell(plan_of(1e-6))}, options);
  try {
    membranes.advance_by(0.05);
    FAIL() << look_at(membranes).strain.largest_stretch;
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("cell 0: the strain of segment "));
    EXPECT_THAT(error.what(), testing::HasSubstr("larger stretch modulus"));
  }
  EXPECT_LT(std::abs(look_at(membranes).strain.area_error), 1e-6);
}

}  // namespace
}  // namespace hemoscale::micro
