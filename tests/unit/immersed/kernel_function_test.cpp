#include <gtest/gtest.h>

#include <cmath>

#include "micro/immersed/kernel_function.hpp"

namespace hemoscale::micro {
namespace {

class Kernel : public testing::TestWithParam<TransferKernel> {};
INSTANTIATE_TEST_SUITE_P(, Kernel,
                         testing::Values(TransferKernel::three_point, TransferKernel::four_point),
                         [](const auto& each) {
                           return each.param == TransferKernel::three_point ? "three_point"
                                                                            : "four_point";
                         });

TEST_P(Kernel, shifted_by_whole_spacings_adds_up_to_one_without_moment) {
  double squares_before = 0;
  for (const double shift : {0.0, 0.13, 0.5, 0.77}) {
    double sum = 0;
    double moment = 0;
    double squares = 0;
    for (int i = -4; i <= 4; ++i) {
      const double w = kernel_weight(GetParam(), i - shift);
      sum += w;
      moment += w * (i - shift);
      squares += w * w;
    }
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_NEAR(moment, 0, 1e-14);
    // The sum of squares does not depend on the shift either (Peskin 2002).
    if (squares_before > 0) {
      EXPECT_NEAR(squares, squares_before, 1e-14);
    }
    squares_before = squares;
  }
}

TEST_P(Kernel, is_even_continuous_and_vanishes_beyond_its_reach) {
  const double reach = kernel_reach(GetParam());
  EXPECT_EQ(kernel_weight(GetParam(), reach + 1e-12), 0);
  EXPECT_NEAR(kernel_weight(GetParam(), reach - 1e-9), 0, 1e-8);
  for (const double r : {0.5, 1.0}) {
    EXPECT_NEAR(kernel_weight(GetParam(), r - 1e-9), kernel_weight(GetParam(), r + 1e-9), 1e-8);
  }
  EXPECT_EQ(kernel_weight(GetParam(), -0.7), kernel_weight(GetParam(), 0.7));
}

TEST(FourPointKernel, gives_odd_and_even_nodes_the_same) {
  for (const double shift : {0.0, 0.31, 0.5}) {
    double even = 0;
    for (int i = -4; i <= 4; i += 2) even += kernel_weight(TransferKernel::four_point, i - shift);
    EXPECT_NEAR(even, 0.5, 1e-14);
  }
}

TEST_P(Kernel, has_the_transform_of_its_moments) {
  EXPECT_NEAR(kernel_transform(GetParam(), 0), 1, 1e-5);
  // By the sums above the transform vanishes at whole multiples of 2 pi.
  EXPECT_NEAR(kernel_transform(GetParam(), 2 * std::acos(-1.0)), 0, 1e-5);
  EXPECT_LT(kernel_transform(GetParam(), 1), 0.9);
}

}  // namespace
}  // namespace hemoscale::micro
