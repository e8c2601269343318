#include "macro/parameter_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "macro/analytic/channel_model.hpp"
#include "macro/analytic/couette.hpp"
#include "macro/analytic/poiseuille.hpp"
#include "macro/analytic/start_up.hpp"
#include "macro/analytic/womersley.hpp"
#include "macro/error.hpp"
#include "macro/viscosity/viscosity_law.hpp"

namespace hemoscale::macro {
namespace {

using testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

template <typename Parameters>
void expect_refused(const Parameters& parameters, const std::string& name) {
  EXPECT_THAT(message_of([&] { check(parameters); }), HasSubstr(": " + name + " = "));
}

TEST(ParameterCheck, message_says_what_is_wrong_what_is_allowed_and_what_to_do) {
  const std::string message = message_of([] {
    require_positive({"Casson law", "mu_inf", -2e-3, "Pa s"}, "give more");
  });
  EXPECT_EQ(message,
            "Casson law: mu_inf = -0.002 Pa s is not admissible; allowed: finite and positive; "
            "give more");
}

TEST(ParameterCheck, accepts_and_refuses_at_the_limits) {
  const auto parameter = [](double value) { return CheckedParameter{"a", "b", value, "-"}; };
  EXPECT_NO_THROW(require_positive(parameter(1e-300), ""));
  EXPECT_THROW(require_positive(parameter(0), ""), ParameterError);
  EXPECT_NO_THROW(require_not_negative(parameter(0), ""));
  EXPECT_THROW(require_not_negative(parameter(-1e-300), ""), ParameterError);
  for (const double broken : {nan, inf}) {
    EXPECT_THROW(require_positive(parameter(broken), ""), ParameterError);
    EXPECT_THROW(require_not_negative(parameter(broken), ""), ParameterError);
    EXPECT_THROW(require_finite(parameter(broken), ""), ParameterError);
  }
}

TEST(ParameterCheck, every_parameter_of_every_law_is_checked) {
  expect_refused(Newtonian{0}, "mu");
  expect_refused(CarreauYasuda{0, 1, 1, 0.5, 2}, "mu0");
  expect_refused(CarreauYasuda{1, -1, 1, 0.5, 2}, "mu_inf");
  expect_refused(CarreauYasuda{1, 0.1, 0, 0.5, 2}, "time");
  expect_refused(CarreauYasuda{1, 0.1, 1, 1.01, 2}, "power");
  expect_refused(CarreauYasuda{1, 0.1, 1, -0.01, 2}, "power");
  expect_refused(CarreauYasuda{1, 0.1, 1, nan, 2}, "power");
  expect_refused(CarreauYasuda{1, 0.1, 1, 0.5, 0}, "transition");
  expect_refused(Casson{-1e-3, 1, 1}, "yield_stress");
  expect_refused(Casson{1e-3, 0, 1}, "mu_inf");
  expect_refused(Casson{1e-3, 1, 0}, "lowest_shear_rate");
  expect_refused(Cross{0, 1, 1, 1}, "mu0");
  expect_refused(Cross{1, -1, 1, 1}, "mu_inf");
  expect_refused(Cross{1, 1, inf, 1}, "time");
  expect_refused(Cross{1, 1, 1, 0}, "power");
  expect_refused(PowerLaw{0, 1, 1, 2}, "consistency");
  expect_refused(PowerLaw{1, 0, 1, 2}, "power");
  expect_refused(PowerLaw{1, 1, 0, 2}, "lowest_shear_rate");
  expect_refused(PowerLaw{1, 1, 2, 2}, "highest_shear_rate");
  expect_refused(PowerLaw{1, 1, 2, inf}, "highest_shear_rate");
  expect_refused(Quemada{0, 4, 2, 1}, "plasma_viscosity");
  expect_refused(Quemada{1, -4, 2, 1}, "k0");
  expect_refused(Quemada{1, 4, -2, 1}, "k_inf");
  expect_refused(Quemada{1, 4, 2, 0}, "critical_shear_rate");
}

TEST(ParameterCheck, laws_at_their_limits_are_accepted) {
  EXPECT_NO_THROW(check(CarreauYasuda{1, 0, 1, 0, 2}));
  EXPECT_NO_THROW(check(CarreauYasuda{1, 2, 1, 1, 0.1}));
  EXPECT_NO_THROW(check(Casson{0, 1, 1e-12}));
  EXPECT_NO_THROW(check(Quemada{1, 0, 0, 1}));
}

TEST(ParameterCheck, a_law_that_is_not_valid_cannot_be_made) {
  EXPECT_THROW(ViscosityLaw{Newtonian{}}, ParameterError);
  EXPECT_THROW(ViscosityLaw{CarreauYasuda{}}, ParameterError);
  EXPECT_THROW(ViscosityLaw{Casson{}}, ParameterError);
  EXPECT_THROW(ViscosityLaw{Cross{}}, ParameterError);
  EXPECT_THROW(ViscosityLaw{PowerLaw{}}, ParameterError);
  EXPECT_THROW(ViscosityLaw{Quemada{}}, ParameterError);
}

TEST(ParameterCheck, every_parameter_of_every_flow_is_checked) {
  expect_refused(PlanePoiseuilleProfile{0, 1, 1}, "height");
  expect_refused(PlanePoiseuilleProfile{1, nan, 1}, "pressure_gradient");
  expect_refused(PlanePoiseuilleProfile{1, 1, 0}, "viscosity");
  expect_refused(PipePoiseuilleProfile{0, 1, 1}, "radius");
  expect_refused(PipePoiseuilleProfile{1, inf, 1}, "pressure_gradient");
  expect_refused(PipePoiseuilleProfile{1, 1, -1}, "viscosity");
  expect_refused(PlaneCouetteProfile{-1, 1}, "height");
  expect_refused(PlaneCouetteProfile{1, inf}, "wall_velocity");
  EXPECT_THROW(SimpleShear<2>{nan}, ParameterError);
  expect_refused(StartUpPoiseuilleProfile{0, 1, 1, 1}, "height");
  expect_refused(StartUpPoiseuilleProfile{1, nan, 1, 1}, "pressure_gradient");
  expect_refused(StartUpPoiseuilleProfile{1, 1, 0, 1}, "viscosity");
  expect_refused(StartUpPoiseuilleProfile{1, 1, 1, 0}, "density");
  expect_refused(StartUpCouetteProfile{0, 1, 1, 1}, "height");
  expect_refused(StartUpCouetteProfile{1, nan, 1, 1}, "wall_velocity");
  expect_refused(StartUpCouetteProfile{1, 1, 0, 1}, "viscosity");
  expect_refused(StartUpCouetteProfile{1, 1, 1, 0}, "density");
  expect_refused(WomersleyChannelProfile{0, 1, 1, 1, 1, 1}, "height");
  expect_refused(WomersleyChannelProfile{1, nan, 1, 1, 1, 1}, "steady_gradient");
  expect_refused(WomersleyChannelProfile{1, 1, nan, 1, 1, 1}, "oscillating_gradient");
  expect_refused(WomersleyChannelProfile{1, 1, 1, 0, 1, 1}, "angular_frequency");
  expect_refused(WomersleyChannelProfile{1, 1, 1, 1, 0, 1}, "viscosity");
  expect_refused(WomersleyChannelProfile{1, 1, 1, 1, 1, 0}, "density");
  expect_refused(WomersleyPipeProfile{0, 1, 1, 1, 1, 1}, "radius");
}

TEST(ParameterCheck, womersley_flows_are_refused_outside_their_range) {
  const auto channel = [](double alpha) {
    return WomersleyChannelProfile{2, 0, 1, alpha * alpha, 1, 1};
  };
  const auto pipe = [](double alpha) { return WomersleyPipeProfile{1, 0, 1, alpha * alpha, 1, 1}; };
  for (const double accepted : {1.001e-3, 0.999e4}) {
    EXPECT_NO_THROW(check(channel(accepted)));
    EXPECT_NO_THROW(check(pipe(accepted)));
  }
  for (const double refused : {0.999e-3, 1.001e4}) {
    expect_refused(channel(refused), "Womersley number");
    expect_refused(pipe(refused), "Womersley number");
  }
}

TEST(ParameterCheck, every_parameter_of_a_channel_is_checked) {
  expect_refused(Channel{0, 0.4, PressureGradient{1}}, "height");
  expect_refused(Channel{1, 1, PressureGradient{1}}, "hematocrit");
  expect_refused(Channel{1, -0.1, PressureGradient{1}}, "hematocrit");
  expect_refused(Channel{1, 0.4, PressureGradient{nan}}, "pressure gradient");
  expect_refused(Channel{1, 0.4, PressureGradient{1e-31}}, "pressure gradient");
  expect_refused(Channel{1, 0.4, MeanVelocity{inf}}, "mean velocity");
  expect_refused(Channel{1, 0.4, MeanVelocity{1e31}}, "mean velocity");
  EXPECT_NO_THROW(check(Channel{1, 0, PressureGradient{0}}));
  EXPECT_NO_THROW(check(Channel{1, 0.99, MeanVelocity{-1e29}}));
  EXPECT_THROW((ChannelModel<2>{Channel{0, 0.4, MeanVelocity{1}}}), ParameterError);
}

}  // namespace
}  // namespace hemoscale::macro
