// Where a steady channel profile exists and is unique, and where it does not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "macro/analytic/channel_model.hpp"
#include "macro/error.hpp"

namespace hemoscale::macro {
namespace {

constexpr double h = 75e-6;  // [m]

// A power law between 1 and 100 1/s, held outside: at slope -1 the stress there is constant.
ViscosityTable thinning_table(double slope) {
  return ViscosityTable({{0.4, {1, 10, 100}, {1, std::pow(10, slope), std::pow(100, slope)}}});
}

std::shared_ptr<const ChannelFlow<2>> solve(const ViscosityLaw& law, const ChannelDrive& drive) {
  return ChannelModel<2>(Channel{h, 0.4, drive}).solve(law);
}

PressureGradient wall_stress(double stress) {
  return {2 * stress / h};
}

// The shear rate that the message of the refusal names [1/s]; -1 if there was none.
double refused_shear_rate(const ViscosityLaw& law, const ChannelDrive& drive) {
  try {
    solve(law, drive);
  } catch (const NumericalError& error) {
    const std::string message = error.what();
    const std::string before = "with the shear rate at ";
    const std::size_t at = message.find(before);
    if (at == std::string::npos) return -2;
    return std::strtod(message.c_str() + at + before.size(), nullptr);
  }
  return -1;
}

TEST(ChannelLimits, a_law_whose_stress_falls_is_refused_and_one_whose_stress_still_rises_is_not) {
  for (const ChannelDrive& drive :
       {ChannelDrive(wall_stress(3)), ChannelDrive(MeanVelocity{100 * h})}) {
    EXPECT_NO_THROW(solve(thinning_table(-0.98), drive));
    const double refused = refused_shear_rate(thinning_table(-1.02), drive);
    EXPECT_GE(refused, 1);
    EXPECT_LE(refused, 100);
  }
}

TEST(ChannelLimits, such_a_law_is_accepted_while_the_wall_stays_below_the_fall) {
  const ViscosityTable law = thinning_table(-1.3);
  EXPECT_NO_THROW(solve(law, wall_stress(0.9)));
  EXPECT_NO_THROW(solve(law, MeanVelocity{0.1 * h}));
  EXPECT_GE(refused_shear_rate(law, wall_stress(1.5)), 1);
  EXPECT_GE(refused_shear_rate(law, MeanVelocity{10 * h}), 1);
}

TEST(ChannelLimits, cross_law_is_refused_beyond_a_power_that_its_plateaus_allow) {
  // The stress of a Cross law with power 2 first falls where mu0 / mu_inf exceeds 9.
  EXPECT_NO_THROW(solve(Cross{8.9, 1, 1, 2}, MeanVelocity{100 * h}));
  const double refused = refused_shear_rate(Cross{9.5, 1, 1, 2}, MeanVelocity{100 * h});
  EXPECT_NEAR(refused, std::sqrt(3.0), 0.5);
}

TEST(ChannelLimits, a_stress_that_no_shear_rate_bears_is_refused) {
  const CarreauYasuda saturating{1, 0, 1, 0, 2};  // stress tends to 1 Pa
  EXPECT_NO_THROW(solve(saturating, wall_stress(0.99)));
  EXPECT_GT(refused_shear_rate(saturating, wall_stress(1.01)), 1e3);
}

TEST(ChannelLimits, extreme_drives_within_the_stated_range_are_solved) {
  for (const double rate : {1.1e-30, 0.9e30}) {
    const auto flow = solve(cho_kensey_1991(), MeanVelocity{rate * h});
    const double mu = rate < 1 ? 56e-3 : 3.45e-3;  // the plateau that all fluid is on
    EXPECT_NEAR(flow->pressure_gradient() * h / (12 * mu * rate), 1, 1e-6);
  }
}

}  // namespace
}  // namespace hemoscale::macro
