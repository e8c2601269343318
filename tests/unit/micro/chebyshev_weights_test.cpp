#include <gtest/gtest.h>

#include <cmath>

#include "micro/ensemble/blocks/chebyshev_weights.hpp"

namespace hemoscale::micro::blocks {
namespace {

/// The factor by which a step multiplies the solution of y' = lambda y, z = dt lambda.
double growth(int stages, double z) {
  const auto weights = chebyshev_weights(stages);
  double second = 0;
  double before = weights[0].force * z;
  for (std::size_t j = 1; j < weights.size(); ++j) {
    const StageWeights<double>& w = weights[j];
    const double next =
        w.before * before + w.second * second + w.force * z * (1 + before) + w.first_force * z;
    second = before;
    before = next;
  }
  return 1 + before;
}

TEST(ChebyshevWeights, are_of_second_order) {
  for (int stages = 2; stages <= 50; ++stages) {
    for (const double z : {0.01, -0.01, -0.02}) {
      EXPECT_NEAR(growth(stages, z), 1 + z + 0.5 * z * z, std::abs(z * z * z) / 5) << stages;
    }
  }
}

TEST(ChebyshevWeights, damp_up_to_the_reach_and_not_beyond) {
  for (int stages = 2; stages <= 50; ++stages) {
    const double reach = chebyshev_reach(stages);
    for (int k = 1; k <= 1000; ++k) {
      EXPECT_LT(std::abs(growth(stages, -reach * k / 1001)), 1) << stages << ", " << k;
    }
    // With an odd number the factor passes through -1 only a little further on.
    EXPECT_GT(std::abs(growth(stages, -(stages % 2 == 0 ? 1.02 : 1.3) * reach)), 1) << stages;
  }
}

TEST(ChebyshevWeights, reach_grows_with_the_square_of_the_stages) {
  EXPECT_NEAR(chebyshev_reach(20), 0.65 * 400, 0.03 * 260);
  EXPECT_NEAR(chebyshev_reach(50), 0.65 * 2500, 0.03 * 1625);
}

}  // namespace
}  // namespace hemoscale::micro::blocks
