#include "micro/stress/run_average.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "micro/error.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::micro {
namespace {

constexpr Run run{.warm_up_strain = 0,
                  .minimum_strain = 5,
                  .maximum_strain = 50,
                  .relative_standard_error = 0.01};

Tensor<2> shear(double value) {
  Tensor<2> stress = Tensor<2>::Zero();
  stress(0, 1) = stress(1, 0) = value;
  return stress;
}

TEST(RunAverage, ends_at_the_minimum_when_there_is_no_noise) {
  RunAverage average(run, 10, 0.001, 0.1);
  int samples = 0;
  while (!average.finished()) {
    average.add(shear(0.02));
    ++samples;
  }
  EXPECT_EQ(samples, 50);
  const Observation<2> o = average.observation();
  EXPECT_EQ(o.termination, Termination::precision_reached);
  EXPECT_DOUBLE_EQ(o.shear_stress.mean, 0.03);
  EXPECT_NEAR(o.averaging_time, 0.5, 1e-12);
  EXPECT_EQ(o.shear_rate, 10);
}

TEST(RunAverage, ends_at_the_maximum_when_the_noise_is_large) {
  RunAverage average(run, -10, 0.001, 0.1);
  std::uint64_t samples = 0;
  while (!average.finished()) {
    average.add(shear(-0.02 * (1 + 5 * normal({1, 1, samples}))));
    ++samples;
  }
  EXPECT_EQ(samples, 500U);
  const Observation<2> o = average.observation();
  EXPECT_EQ(o.termination, Termination::allowance_spent);
  EXPECT_NEAR(o.shear_stress.mean, -0.03, 4 * o.shear_stress.standard_error);
}

TEST(RunAverage, ends_between_when_the_error_is_small_enough) {
  RunAverage average(run, 10, 0.001, 0.1);
  std::uint64_t samples = 0;
  while (!average.finished()) {
    average.add(shear(0.02 + 0.03 * 0.14 * normal({1, 1, samples++})));
  }
  const Observation<2> o = average.observation();
  EXPECT_EQ(o.termination, Termination::precision_reached);
  EXPECT_LE(o.shear_stress.standard_error, 0.01 * o.shear_stress.mean);
  EXPECT_GT(samples, 50U);
  EXPECT_LT(samples, 500U);
}

TEST(RunAverage, takes_the_symmetric_part_and_the_normal_difference) {
  RunAverage average(run, 10, 0, 50);
  Tensor<2> stress;
  stress << 3, 1, 2, -4;
  average.add(stress);
  ASSERT_TRUE(average.finished());
  EXPECT_DOUBLE_EQ(average.observation().shear_stress.mean, 1.5);
  EXPECT_DOUBLE_EQ(average.observation().first_normal_difference.mean, 7);
}

TEST(RunAverage, refuses_runs_that_cannot_end) {
  const auto broken = [](micro::Run r) { EXPECT_THROW(require_admissible(r), ParameterError); };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(require_admissible(run));
  broken({-1, 5, 50, 0.01});
  broken({nan, 5, 50, 0.01});
  broken({0, 0, 50, 0.01});
  broken({0, nan, 50, 0.01});
  broken({0, 5, 4, 0.01});
  broken({0, 5, std::numeric_limits<double>::infinity(), 0.01});
  broken({0, 5, 50, 0});
  broken({0, 5, 50, 1});
  broken({0, 5, 50, nan});
}

}  // namespace
}  // namespace hemoscale::micro
