#include "coupling/rheology/monotone_regression.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hemoscale::coupling {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;

TEST(MonotoneFit, leaves_decreasing_values_alone) {
  const MonotoneFit fit = fit_not_increasing({{3, 1}, {2, 0.1}, {2, 5}, {-1, 1}});
  EXPECT_THAT(fit.values, ElementsAre(3, 2, 2, -1));
  EXPECT_THAT(fit.block_begin, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(fit.block_end, ElementsAre(1, 2, 3, 4));
}

TEST(MonotoneFit, pools_violators_with_weights_of_one_over_error_squared) {
  const MonotoneFit fit = fit_not_increasing({{9, 1}, {1, 1}, {6, 2}, {0, 1}});
  const double pooled = (1 * 1 + 6 * 0.25) / 1.25;
  EXPECT_THAT(fit.values, ElementsAre(9, DoubleEq(pooled), DoubleEq(pooled), 0));
  EXPECT_THAT(fit.block_begin, ElementsAre(0, 1, 1, 3));
  EXPECT_THAT(fit.block_end, ElementsAre(1, 3, 3, 4));
}

TEST(MonotoneFit, a_late_rise_pools_back_to_the_first_entry) {
  const MonotoneFit fit = fit_not_increasing({{2, 1}, {1, 1}, {0, 1}, {9, 1}});
  EXPECT_THAT(fit.values, ElementsAre(3, 3, 3, 3));
}

TEST(MonotoneFit, exact_values_outweigh_all_others) {
  const MonotoneFit fit = fit_not_increasing({{1, 0.01}, {2, 0}, {5, 0.01}});
  EXPECT_THAT(fit.values, ElementsAre(2, 2, 2));
  EXPECT_EQ(weighted_mean({{1, 0}, {2, 0}, {77, 1e-9}}, 0, 2), 1.5);
}

}  // namespace
}  // namespace hemoscale::coupling
