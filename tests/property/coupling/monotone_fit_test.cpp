#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "coupling/rheology/monotone_regression.hpp"

namespace hemoscale::coupling {
namespace {

// Raw bits alone: the distributions of the standard library differ between platforms.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

 private:
  std::mt19937_64 engine_;
};

std::vector<Uncertain> random_values(Random& random) {
  std::vector<Uncertain> values(1 + static_cast<std::size_t>(random.between(0, 12)));
  for (Uncertain& x : values) x = {random.between(-1, 1), random.between(0.05, 1)};
  return values;
}

double cost(const std::vector<Uncertain>& values, const std::vector<double>& fit) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += std::pow((fit[i] - values[i].value) / values[i].error, 2);
  }
  return sum;
}

// The set of decreasing sequences is convex, so the fit is the minimum if no admissible direction
// lowers the cost; random admissible sequences are such directions.
TEST(MonotoneFitProperty, is_decreasing_and_the_least_squares_one) {
  Random random(11);
  for (int repeat = 0; repeat < 300; ++repeat) {
    const std::vector<Uncertain> values = random_values(random);
    const std::vector<double> fit = fit_not_increasing(values).values;
    EXPECT_TRUE(std::is_sorted(fit.rbegin(), fit.rend()));
    const double least = cost(values, fit);
    for (int trial = 0; trial < 50; ++trial) {
      std::vector<double> other;
      for (std::size_t i = 0; i < fit.size(); ++i) other.push_back(random.between(-1, 1));
      std::sort(other.rbegin(), other.rend());
      for (const double step : {1e-4, 0.1, 1.0}) {
        std::vector<double> moved = fit;
        for (std::size_t i = 0; i < fit.size(); ++i) moved[i] += step * (other[i] - fit[i]);
        ASSERT_GE(cost(values, moved), least * (1 - 1e-12));
      }
    }
  }
}

// The statement behind the confidence band: if every raw value lies within its half-width of a
// decreasing truth, so does every fitted value within the width stated for it.
TEST(MonotoneFitProperty, errors_stay_within_the_widths_stated_for_the_blocks) {
  Random random(12);
  int pooled = 0;
  double tightest = 1;
  for (int repeat = 0; repeat < 3000; ++repeat) {
    std::vector<Uncertain> values = random_values(random);
    std::vector<double> truth;
    for (std::size_t i = 0; i < values.size(); ++i) truth.push_back(random.between(0, 0.3));
    std::sort(truth.rbegin(), truth.rend());
    std::vector<Uncertain> widths;
    for (std::size_t i = 0; i < values.size(); ++i) {
      widths.push_back({random.between(1, 4) * values[i].error, values[i].error});
      const double extreme = random.between(0, 1) < 0.5 ? -1 : 1;
      values[i].value = truth[i] + extreme * widths[i].value;
    }
    const MonotoneFit fit = fit_not_increasing(values);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double width = std::max(weighted_mean(widths, fit.block_begin[i], i),
                                    weighted_mean(widths, i, fit.block_end[i] - 1));
      const double error = std::abs(fit.values[i] - truth[i]);
      ASSERT_LE(error, width * (1 + 1e-12));
      if (fit.block_end[i] - fit.block_begin[i] > 1) {
        ++pooled;
        tightest = std::min(tightest, 1 - error / width);
      }
    }
  }
  EXPECT_GT(pooled, 1000);
  EXPECT_LT(tightest, 0.05);  // the width is not generous either
}

}  // namespace
}  // namespace hemoscale::coupling
