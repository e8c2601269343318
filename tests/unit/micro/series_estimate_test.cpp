#include "micro/stress/series_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "micro/error.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::micro {
namespace {

TEST(SeriesEstimate, of_a_constant_has_no_error) {
  const std::vector<double> series(100, 0.1);
  const Estimate e = estimate_mean(series, 2);
  EXPECT_DOUBLE_EQ(e.mean, 0.1);
  EXPECT_EQ(e.standard_error, 0);
}

TEST(SeriesEstimate, of_one_sample_knows_nothing) {
  const std::vector<double> series = {3};
  const Estimate e = estimate_mean(series, 1);
  EXPECT_EQ(e.mean, 3);
  EXPECT_TRUE(std::isinf(e.standard_error));
}

TEST(SeriesEstimate, of_independent_samples_is_the_textbook_formula) {
  std::vector<double> series;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    series.push_back(5 + 2 * normal({1, 2, i}));
  }
  const Estimate e = estimate_mean(series, 0.1);
  EXPECT_NEAR(e.standard_error, 2 / std::sqrt(20000.0), 0.05 * 2 / std::sqrt(20000.0));
  EXPECT_NEAR(e.correlation_time, 0.05, 0.005);
  EXPECT_NEAR(e.mean, 5, 4 * e.standard_error);
}

TEST(SeriesEstimate, does_not_credit_antithetic_series) {
  std::vector<double> series;
  for (int i = 0; i < 1000; ++i) {
    series.push_back(i % 2);
  }
  const Estimate e = estimate_mean(series, 1);
  EXPECT_NEAR(e.standard_error, 0.5 / std::sqrt(1000.0), 1e-12);
}

TEST(BlockStandardError, is_the_scatter_of_block_means) {
  const std::vector<double> series = {1, 3, 5, 7, 9, 100};
  EXPECT_DOUBLE_EQ(block_standard_error(std::vector<double>{1, 3, 5, 7}, 2), 2);
  EXPECT_DOUBLE_EQ(block_standard_error(std::vector<double>{1, 3, 5, 7, 1000}, 2), 2);
  EXPECT_THROW(block_standard_error(series, 1), ParameterError);
  EXPECT_THROW(block_standard_error(series, 7), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
