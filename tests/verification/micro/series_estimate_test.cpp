#include "micro/stress/series_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "micro/random/philox.hpp"

namespace hemoscale::micro {
namespace {

struct Replicas {
  double reported = 0;  // mean standard error
  double covered = 0;   // share of one-sigma bars that hold the true mean
  double tau = 0;       // mean correlation time over the true one
  double blocks = 0;    // mean of the block estimate
};

/// First-order autoregressions with correlation exp(-1/decay), mean 2, unit variance.
Replicas run_replicas(double decay, std::size_t length, std::uint64_t count) {
  const double memory = std::exp(-1 / decay);
  const double exact_tau = 0.5 * (1 + memory) / (1 - memory);
  Replicas result;
  for (std::uint64_t replica = 0; replica < count; ++replica) {
    std::vector<double> series;
    series.reserve(length);
    double value = normal({99, replica, 0});
    for (std::uint64_t i = 1; i <= length; ++i) {
      value = memory * value + std::sqrt(1 - memory * memory) * normal({99, replica, i});
      series.push_back(2 + value);
    }
    const Estimate e = estimate_mean(series, 1);
    const auto n = static_cast<double>(count);
    result.reported += e.standard_error / n;
    result.covered += (std::abs(e.mean - 2) <= e.standard_error ? 1 : 0) / n;
    result.tau += e.correlation_time / exact_tau / n;
    result.blocks += block_standard_error(series, 20) / n;
  }
  return result;
}

/// Exact standard error of the mean of n samples of such a series.
double exact_error(double decay, double n) {
  const double memory = std::exp(-1 / decay);
  return std::sqrt(((1 + memory) / (1 - memory) -
                    2 * memory * (1 - std::pow(memory, n)) / (n * (1 - memory) * (1 - memory))) /
                   n);
}

TEST(SeriesEstimate, standard_error_of_autoregressions_is_right_within_ten_percent) {
  for (const double decay : {2.0, 10.0, 25.0}) {
    const double tau = 0.5 * (1 + std::exp(-1 / decay)) / (1 - std::exp(-1 / decay));
    const auto length = static_cast<std::size_t>(200 * tau);
    const Replicas r = run_replicas(decay, length, 200);
    const double exact = exact_error(decay, static_cast<double>(length));
    EXPECT_NEAR(r.reported, exact, 0.1 * exact) << decay;
    EXPECT_NEAR(r.blocks, exact, 0.1 * exact) << decay;
    EXPECT_NEAR(r.tau, 1, 0.15) << decay;
  }
}

TEST(SeriesEstimate, one_sigma_bars_cover_two_thirds) {
  const Replicas r = run_replicas(10, 2000, 200);
  EXPECT_GE(r.covered, 0.62);
  EXPECT_LE(r.covered, 0.74);
}

}  // namespace
}  // namespace hemoscale::micro
