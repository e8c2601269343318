#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "micro/ensemble/ensemble_model.hpp"
#include "tests/support/micro/ensembles.hpp"

namespace hemoscale::micro {
namespace {

// Positions after a fixed time, with steps that divide it, against a much finer step.
TEST(EulerOrder, positions_converge_with_first_order) {
  EnsembleParameters p = test::small_ensemble();
  const double limit = step_limit(p).time_step;
  const double duration = 400 * 0.8 * limit;
  const auto positions = [&](int steps) {
    p.time_step = duration / steps;
    EnsembleModel model(p, 1);
    model.advance_by(test::shear(200, 0.3), duration);
    return model.frame().positions;
  };
  const std::vector<double> reference = positions(12800);
  const auto error = [&](int steps) {
    const std::vector<double> x = positions(steps);
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      sum += std::pow(x[i] - reference[i], 2);
    }
    return std::sqrt(sum / static_cast<double>(x.size()));
  };
  const double coarse = error(400);
  const double middle = error(800);
  const double fine = error(1600);
  EXPECT_LT(coarse, 0.01e-6);
  // The reference itself is not exact: orders come out above one by its share of the error.
  EXPECT_NEAR(std::log2(coarse / middle), 1, 0.1);
  EXPECT_NEAR(std::log2(middle / fine), 1, 0.2);
}

}  // namespace
}  // namespace hemoscale::micro
