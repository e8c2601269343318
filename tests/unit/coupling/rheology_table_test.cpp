#include "coupling/rheology/rheology_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "coupling/rheology/student_t.hpp"

namespace hemoscale::coupling {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;

RheologySample sample(double rate, double viscosity, double relative_error,
                      double effective_samples = 400, double hematocrit = 0.4) {
  RheologySample s;
  s.shear_rate = rate;
  s.hematocrit = hematocrit;
  s.viscosity = viscosity;
  s.shear_stress = rate * viscosity;
  s.viscosity_error = relative_error * viscosity;
  s.effective_samples = effective_samples;
  return s;
}

FitBounds wide() {
  FitBounds bounds;
  bounds.lowest_viscosity = 1e-6;
  bounds.highest_viscosity = 1e3;
  return bounds;
}

TEST(RheologyTable, law_passes_through_decreasing_samples_in_any_order) {
  const RheologyTable table({sample(100, 2, 0.01), sample(1, 5, 0.01), sample(10, 3, 0.01)},
                            wide());
  EXPECT_DOUBLE_EQ(table.law().viscosity(1, 0.4), 5);
  EXPECT_DOUBLE_EQ(table.law().viscosity(10, 0.4), 3);
  EXPECT_DOUBLE_EQ(table.law().viscosity(100, 0.4), 2);
  EXPECT_EQ(table.knots_pooled_by_monotonicity(), 0);
  EXPECT_EQ(table.knots_moved_by_bounds(), 0);
  EXPECT_EQ(table.knots_merged_for_rising_stress(), 0);
}

TEST(RheologyTable, one_sample_makes_a_constant_law_that_is_trusted_there_alone) {
  const RheologyTable table({sample(10, 3, 0.01)}, wide());
  EXPECT_DOUBLE_EQ(table.law().viscosity(1e-3, 0.4), 3);
  EXPECT_DOUBLE_EQ(table.law().viscosity(1e5, 0.4), 3);
  EXPECT_TRUE(table.is_trusted(10, 0.4));
  EXPECT_FALSE(table.is_trusted(10.1, 0.4));
  EXPECT_FALSE(table.is_trusted(10, 0.41));
  EXPECT_TRUE(std::isinf(table.log_half_width(10.1, 0.4)));
}

TEST(RheologyTable, half_width_is_student_t_times_the_error_at_a_knot) {
  const RheologyTable table({sample(1, 5, 0.02, 80), sample(10, 3, 0.01, 40)}, wide());
  const double p = std::sqrt(0.95);
  EXPECT_NEAR(table.log_half_width(1, 0.4), 0.02 * student_t_half_width(p, 20), 1e-14);
  EXPECT_NEAR(table.log_half_width(10, 0.4), 0.01 * student_t_half_width(p, 10), 1e-14);
}

TEST(RheologyTable, between_knots_the_band_is_no_narrower_than_at_the_wider_one) {
  const RheologyTable table({sample(1, 5, 0.02), sample(100, 3, 0.001)}, wide());
  const double wider = table.log_half_width(1, 0.4);
  EXPECT_GT(table.log_half_width(99.9, 0.4), wider);
  EXPECT_NEAR(table.log_half_width(10, 0.4), 1.25 * wider, 1e-12);  // the middle in logarithms
}

TEST(RheologyTable, samples_at_nearly_one_shear_rate_are_pooled) {
  Pooling pooling;
  pooling.shear_ratio = 1.05;
  const RheologyTable table({sample(100, 2, 0.01), sample(103, 2.2, 0.02), sample(300, 1, 0.01)},
                            wide(), pooling);
  ASSERT_EQ(table.rows().size(), 1u);
  ASSERT_EQ(table.rows()[0].shear_rates.size(), 2u);
  const double share = (1 / 1e-4) / (1 / 1e-4 + 1 / 4e-4);
  EXPECT_NEAR(table.rows()[0].viscosities[0],
              std::exp(share * std::log(2) + (1 - share) * std::log(2.2)), 1e-12);
  EXPECT_NEAR(table.rows()[0].shear_rates[0],
              std::exp(share * std::log(100) + (1 - share) * std::log(103)), 1e-10);
  const double plain = 1 / std::sqrt(1 / 1e-4 + 1 / 4e-4);
  EXPECT_GT(table.log_errors()[0][0], plain);  // weights are estimates (Meier 1953)
  EXPECT_LT(table.log_errors()[0][0], 1.01 * plain);
}

TEST(RheologyTable, samples_just_too_far_apart_are_not_pooled) {
  Pooling pooling;
  pooling.shear_ratio = 1.05;
  const auto knots = [&](double rate) {
    return RheologyTable({sample(100, 2, 0.01), sample(rate, 1.99, 0.01)}, wide(), pooling)
        .rows()[0]
        .shear_rates.size();
  };
  EXPECT_EQ(knots(104.9), 1u);
  EXPECT_EQ(knots(105.1), 2u);
}

TEST(RheologyTable, a_rise_with_shear_rate_is_pooled_and_counted_unless_allowed) {
  const std::vector<RheologySample> samples = {sample(1, 3, 0.01), sample(10, 4, 0.01),
                                               sample(100, 1, 0.01)};
  const RheologyTable table(samples, wide());
  EXPECT_EQ(table.knots_pooled_by_monotonicity(), 2);
  EXPECT_NEAR(table.law().viscosity(1, 0.4), std::sqrt(12.0), 1e-12);
  EXPECT_NEAR(table.law().viscosity(10, 0.4), std::sqrt(12.0), 1e-12);
  FitBounds bounds = wide();
  bounds.shear_thinning = false;
  const RheologyTable free(samples, bounds);
  EXPECT_EQ(free.knots_pooled_by_monotonicity(), 0);
  EXPECT_DOUBLE_EQ(free.law().viscosity(10, 0.4), 4);
}

TEST(RheologyTable, pooled_knots_get_the_width_that_is_certain_to_cover) {
  const RheologyTable table({sample(1, 3, 0.01), sample(10, 3.01, 0.02)}, wide());
  const double t = student_t_half_width(std::sqrt(0.95), 100);
  // Of the first knot: the larger of its own width and the mean of both with weights 1 / error^2.
  const double mean = (t * 0.01 / 1e-4 + t * 0.02 / 4e-4) / (1 / 1e-4 + 1 / 4e-4);
  EXPECT_NEAR(table.log_half_width(1, 0.4), mean, 1e-12);
  EXPECT_NEAR(table.log_half_width(10, 0.4), t * 0.02, 1e-12);
}

TEST(RheologyTable, bounds_move_knots_and_count_them) {
  FitBounds bounds = wide();
  bounds.lowest_viscosity = 2.5;
  bounds.highest_viscosity = 4.5;
  const RheologyTable table({sample(1, 5, 0.01), sample(10, 3, 0.01), sample(100, 2, 0.01)},
                            bounds);
  EXPECT_THAT(table.rows()[0].viscosities, ElementsAre(4.5, DoubleEq(3), 2.5));
  EXPECT_EQ(table.knots_moved_by_bounds(), 2);
}

// Two knots so close, and so different by noise, that the shear stress would fall between them.
TEST(RheologyTable, knots_are_merged_where_shear_stress_would_fall) {
  const std::vector<RheologySample> samples = {sample(10, 3, 0.05), sample(11, 2.5, 0.05),
                                               sample(100, 2, 0.05)};
  const RheologyTable table(samples, wide());
  EXPECT_EQ(table.knots_merged_for_rising_stress(), 1);
  ASSERT_EQ(table.rows()[0].shear_rates.size(), 2u);
  double stress = 0;
  for (double rate = 5; rate < 200; rate *= 1.01) {
    const double next = rate * table.law().viscosity(rate, 0.4);
    EXPECT_GT(next, stress) << rate;
    stress = next;
  }
  // Just less steep than the bound: nothing happens.
  const RheologyTable kept({sample(10, 3, 0.05), sample(11, 3 * std::pow(1.1, -0.98), 0.05)},
                           wide());
  EXPECT_EQ(kept.knots_merged_for_rising_stress(), 0);
}

TEST(RheologyTable, exact_samples_have_no_width) {
  const RheologyTable table({sample(1, 5, 0), sample(10, 3, 0)}, wide());
  EXPECT_EQ(table.log_half_width(3, 0.4), 0);
}

TEST(RheologyTable, too_few_samples_for_any_statement_give_an_infinite_width) {
  const RheologyTable table({sample(1, 5, 0.1, 0)}, wide());
  EXPECT_TRUE(std::isinf(table.log_half_width(1, 0.4)));
  EXPECT_TRUE(table.is_trusted(1, 0.4));
}

TEST(RheologyTable, rows_of_hematocrit_are_trusted_between_and_share_the_band) {
  const RheologyTable table(
      {sample(1, 4, 0.01, 400, 0.3), sample(100, 2, 0.01, 400, 0.3), sample(2, 8, 0.02, 400, 0.5),
       sample(50, 5, 0.02, 400, 0.5), sample(50, 5.1, 0.02, 400, 0.5005)},
      wide());
  ASSERT_EQ(table.rows().size(), 2u);
  EXPECT_TRUE(table.is_trusted(10, 0.4));
  EXPECT_FALSE(table.is_trusted(1.5, 0.4));  // below the row at 0.5
  EXPECT_TRUE(table.is_trusted(1.5, 0.3));
  EXPECT_FALSE(table.is_trusted(10, 0.29));
  EXPECT_FALSE(table.is_trusted(10, 0.52));
  EXPECT_EQ(table.log_half_width(10, 0.4),
            std::max(table.log_half_width(10, 0.3), table.log_half_width(10, 0.5)));
  const double p = sidak_probability(0.95, 4);  // four knots in all
  EXPECT_NEAR(table.log_half_width(1, 0.3), 0.01 * student_t_half_width(p, 100), 1e-14);
}

TEST(RheologyTable, law_does_not_depend_on_the_order_of_the_samples) {
  std::vector<RheologySample> samples;
  for (int i = 0; i < 30; ++i) {
    samples.push_back(sample(1 + (i * 7) % 30, 3 + std::sin(i), 0.01 * (1 + i % 3)));
  }
  const RheologyTable forward(samples, wide());
  std::reverse(samples.begin(), samples.end());
  const RheologyTable backward(samples, wide());
  EXPECT_EQ(forward.rows()[0].shear_rates, backward.rows()[0].shear_rates);
  EXPECT_EQ(forward.rows()[0].viscosities, backward.rows()[0].viscosities);
}

TEST(RheologyTable, bad_input_is_refused) {
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  const auto refused = [&](const std::vector<RheologySample>& samples, const FitBounds& bounds) {
    EXPECT_THROW(RheologyTable(samples, bounds), std::invalid_argument);
  };
  refused({}, wide());
  refused({sample(0, 1, 0.1)}, wide());
  refused({sample(nan, 1, 0.1)}, wide());
  refused({sample(1, -1, 0.1)}, wide());
  refused({sample(1, 1, -0.1)}, wide());
  refused({sample(1, 1, infinity)}, wide());
  refused({sample(1, 1, 0.1, 10, -0.1)}, wide());
  refused({sample(1, 1, 0.1)}, FitBounds{});
  FitBounds bounds = wide();
  bounds.steepest_slope = -1;
  refused({sample(1, 1, 0.1)}, bounds);
  RheologySample in_space = sample(2, 1, 0.1);
  in_space.dimension = 3;
  refused({sample(1, 1, 0.1), in_space}, wide());
  EXPECT_THROW(RheologyTable({sample(1, 1, 0.1)}, wide(), Pooling{0.9, 0}), std::invalid_argument);
  EXPECT_THROW(RheologyTable({sample(1, 1, 0.1)}, wide(), Pooling{1, -1}), std::invalid_argument);
}

}  // namespace
}  // namespace hemoscale::coupling
