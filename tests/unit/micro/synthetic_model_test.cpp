#include "micro/synthetic/synthetic_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

double thinning(double shear_rate, double hematocrit) {
  return 1e-3 * (1 + 5 * hematocrit) * (1 + 1 / std::sqrt(shear_rate));
}

constexpr Run run{.warm_up_strain = 10,
                  .minimum_strain = 20,
                  .maximum_strain = 5000,
                  .relative_standard_error = 0.005};

Forcing<2> forcing(double rate) {
  Forcing<2> f;
  f.velocity_gradient(0, 1) = rate;
  f.hematocrit = 0.4;
  return f;
}

TEST(SyntheticModel, returns_its_law_within_the_error) {
  for (const double rate : {20.0, -100.0, 300.0}) {
    SyntheticModel model({.law = thinning, .noise = 0.1}, 3);
    const Observation<2> o = model.advance(forcing(rate), run);
    const double stress = thinning(std::abs(rate), 0.4) * rate;
    EXPECT_EQ(o.termination, Termination::precision_reached);
    EXPECT_LE(o.shear_stress.standard_error, 0.005 * std::abs(stress) * 1.02);
    EXPECT_NEAR(o.shear_stress.mean, stress, 4 * o.shear_stress.standard_error);
    EXPECT_NEAR(o.particle_stress(0, 1) + 1.2e-3 * rate, o.shear_stress.mean, 1e-12);
    EXPECT_NEAR(o.shear_stress.correlation_time * std::abs(rate), 1, 0.35);
    EXPECT_EQ(o.hematocrit, 0.4);
    EXPECT_DOUBLE_EQ(o.shear_rate, std::abs(rate));
  }
}

TEST(SyntheticModel, without_noise_is_exact_and_ends_at_the_minimum) {
  SyntheticModel model({.law = thinning, .noise = 0}, 3);
  const Observation<2> o = model.advance(forcing(50), run);
  EXPECT_NEAR(o.shear_stress.mean, thinning(50, 0.4) * 50, 1e-15);
  EXPECT_NEAR(o.averaging_time * 50, 20, 0.06);
}

TEST(SyntheticModel, seed_and_stream_decide_the_noise) {
  const auto mean = [](std::uint64_t seed, std::uint64_t stream) {
    SyntheticModel model({.law = thinning}, seed, stream);
    return model.advance(forcing(50), run).shear_stress.mean;
  };
  EXPECT_EQ(mean(1, 1), mean(1, 1));
  EXPECT_NE(mean(1, 1), mean(2, 1));
  EXPECT_NE(mean(1, 1), mean(1, 2));
}

TEST(SyntheticModel, refuses_broken_input) {
  EXPECT_THROW(SyntheticModel({}, 1), ParameterError);
  EXPECT_THROW(SyntheticModel({.law = thinning, .noise = -1}, 1), ParameterError);
  EXPECT_THROW(SyntheticModel({.law = thinning, .correlation_strain = 0}, 1), ParameterError);
  EXPECT_THROW(SyntheticModel({.law = thinning, .sampling_strain = 0}, 1), ParameterError);
  EXPECT_THROW(SyntheticModel({.law = thinning, .plasma_viscosity = 0}, 1), ParameterError);
  SyntheticModel model({.law = thinning}, 1);
  EXPECT_THROW(model.advance(forcing(0), run), ParameterError);
  EXPECT_THROW(model.advance(forcing(std::numeric_limits<double>::quiet_NaN()), run),
               ParameterError);
  EXPECT_THROW(model.advance(forcing(10), {}), ParameterError);
  SyntheticModel negative({.law = [](double, double) { return -1.0; }}, 1);
  EXPECT_THROW(negative.advance(forcing(10), run), ParameterError);
  EXPECT_THROW(model.restore({}), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
