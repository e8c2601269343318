#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "coupling/rheology/rheology_table.hpp"
#include "coupling/transfer/to_forcing.hpp"
#include "coupling/transfer/to_rheology.hpp"
#include "tests/support/coupling_doubles.hpp"

namespace hemoscale::coupling {
namespace {

constexpr double hematocrit = 0.4;

// Samples of a known law at `count` shear rates spread evenly in the logarithm.
RheologyTable measured(const macro::ViscosityLaw& law, double lowest, double highest, int count,
                       double noise, const micro::Run& run, std::uint64_t seed) {
  const MicroFactory factory = testing::synthetic(law, noise, seed);
  std::vector<RheologySample> samples;
  for (int k = 0; k < count; ++k) {
    const double rate = lowest * std::pow(highest / lowest, double(k) / (count - 1));
    const auto observation = factory(k)->advance(simple_shear(rate, hematocrit).forcing, run);
    samples.push_back(to_rheology<2>(observation, hematocrit));
  }
  FitBounds bounds;
  bounds.lowest_viscosity = 1e-4;
  bounds.highest_viscosity = 10;
  return RheologyTable(samples, bounds);
}

struct Coverage {
  int seeds_covered = 0;
  double mean_half_width = 0;  // [-] of log viscosity
  double mean_error = 0;       // [-] standard error of log viscosity
};

// Is the law inside the band at all of 50 shear rates at once?
Coverage coverage(const macro::ViscosityLaw& law, double lowest, double highest, int knots,
                  const micro::Run& run) {
  Coverage result;
  constexpr int seeds = 100;
  for (int seed = 1; seed <= seeds; ++seed) {
    const RheologyTable table =
        measured(law, lowest, highest, knots, 0.05, run, static_cast<std::uint64_t>(seed));
    bool inside = true;
    for (int k = 0; k < 50; ++k) {
      const double rate = lowest * std::pow(highest / lowest, k / 49.0);
      EXPECT_TRUE(table.is_trusted(rate, hematocrit));
      const double width = table.log_half_width(rate, hematocrit);
      const double error =
          std::log(table.law().viscosity(rate, hematocrit) / law.viscosity(rate, hematocrit));
      inside = inside && std::abs(error) <= width;
      result.mean_half_width += width / (50 * seeds);
    }
    for (const double error : table.log_errors().at(0)) {
      result.mean_error += error / (knots * seeds);
    }
    result.seeds_covered += inside;
  }
  ::testing::Test::RecordProperty("seeds_covered", result.seeds_covered);
  ::testing::Test::RecordProperty("half_width_over_error",
                                  std::to_string(result.mean_half_width / result.mean_error));
  return result;
}

TEST(ConfidenceBand, holds_carreau_yasuda_in_93_of_100_seeds) {
  const Coverage result = coverage(testing::blood(), 2, 500, 8, testing::short_run());
  EXPECT_GE(result.seeds_covered, 93);
  EXPECT_LT(result.mean_half_width, 8 * result.mean_error);
}

TEST(ConfidenceBand, holds_a_power_law_in_93_of_100_seeds) {
  const Coverage result =
      coverage(testing::power_law(0.02, 0.6), 10, 1000, 6, testing::short_run());
  EXPECT_GE(result.seeds_covered, 93);
  EXPECT_LT(result.mean_half_width, 8 * result.mean_error);
}

TEST(ConfidenceBand, holds_with_longer_runs_and_is_narrower_then) {
  micro::Run run = testing::short_run();
  run.minimum_strain = 200;
  run.maximum_strain = 400;
  const Coverage result = coverage(testing::blood(), 2, 500, 8, run);
  EXPECT_GE(result.seeds_covered, 93);
  EXPECT_LT(result.mean_half_width, 4 * result.mean_error);
}

// The band leaves out the error of interpolation. It is small beside the band of runs of 2 % even
// for the few knots that a single pass gives, and falls with the third power of their distance.
// The band leaves out the error of interpolation. It is small beside the band of runs of 2 % even
// for the few knots that a single pass gives, and falls with the third power of their distance.
TEST(ConfidenceBand, error_of_interpolation_is_small_and_of_third_order) {
  const macro::ViscosityLaw law = testing::blood();
  const auto worst = [&](int knots) {
    std::vector<RheologySample> samples(static_cast<std::size_t>(knots));
    for (int k = 0; k < knots; ++k) {
      RheologySample& sample = samples[static_cast<std::size_t>(k)];
      sample.shear_rate = 2 * std::pow(250, double(k) / (knots - 1));
      sample.hematocrit = hematocrit;
      sample.viscosity = law.viscosity(sample.shear_rate, hematocrit);
    }
    FitBounds bounds;
    bounds.highest_viscosity = 10;
    const RheologyTable table(samples, bounds);
    double result = 0;
    for (double rate = 2; rate < 500; rate *= 1.01) {
      result = std::max(result, std::abs(std::log(table.law().viscosity(rate, hematocrit) /
                                                  law.viscosity(rate, hematocrit))));
    }
    return result;
  };
  const double coarse = worst(8);
  const double order = std::log2(worst(29) / worst(57));
  RecordProperty("error_with_8_knots", std::to_string(coarse));
  RecordProperty("order", std::to_string(order));
  EXPECT_LT(coarse, 2e-3);
  EXPECT_GT(order, 2.5);
}

}  // namespace
}  // namespace hemoscale::coupling
