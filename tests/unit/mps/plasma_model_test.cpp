#include "micro/mps/plasma_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "micro/error.hpp"
#include "micro/mps/inlet_flux.hpp"
#include "tests/support/mps/flows.hpp"

namespace hemoscale::micro {
namespace {

using testing::HasSubstr;
using namespace test;

constexpr Fluid fluid{.density = 1, .kinematic_viscosity = 1};
constexpr Run until_steady{
    .minimum_strain = 1, .maximum_strain = 50, .relative_standard_error = 1e-9};

Forcing<2> profile_of(double speed) {
  Forcing<2> forcing;
  VelocityProfile profile{.height = 1, .velocities = {}};
  for (int k = 0; k <= 8; ++k) profile.velocities.push_back(speed * parabola(k / 8.0));
  forcing.profile = profile;
  return forcing;
}

PlasmaModel<2> open_model(const StageOptions& options = {}) {
  return {open_channel(10), fluid, options, 0.05,
          ChannelSections{.height = 1, .upstream = 1, .downstream = 2}};
}

TEST(PlasmaModel, answers_a_profile_with_flow_rate_pressure_drop_and_wall_stress) {
  PlasmaModel<2> model = open_model();
  const Observation<2> seen = model.advance(profile_of(2), until_steady);
  EXPECT_EQ(seen.termination, Termination::precision_reached);
  ASSERT_TRUE(seen.channel);
  EXPECT_NEAR(seen.channel->flow_rate, 2, 1e-6);
  EXPECT_NEAR(seen.channel->pressure_drop, 24, 1e-4);
  EXPECT_NEAR(seen.channel->wall_shear_stress, 12, 1e-4);
  EXPECT_NEAR(seen.shear_stress.mean, 12, 1e-4);
  ASSERT_EQ(seen.ledger.size(), 1U);
  EXPECT_LT(seen.ledger[0].deviation, 1e-6);
}

TEST(PlasmaModel, follows_a_new_forcing) {
  PlasmaModel<2> model = open_model();
  model.advance(profile_of(2), until_steady);
  EXPECT_NEAR(model.advance(profile_of(0.5), until_steady).channel->flow_rate, 0.5, 1e-6);
}

TEST(PlasmaModel, is_driven_by_a_body_force) {
  PlasmaModel<2> model(channel_nodes(2, 1, true, {.spacing = 0.1}), fluid, StageOptions{}, 0.05,
                       ChannelSections{.height = 1, .upstream = 0.5, .downstream = 1.5});
  Forcing<2> forcing;
  forcing.body_force = {12, 0};
  const Observation<2> seen = model.advance(forcing, until_steady);
  EXPECT_NEAR(seen.channel->flow_rate, 1, 1e-7);
  EXPECT_NEAR(seen.channel->wall_shear_stress, 6, 1e-6);
}

TEST(PlasmaModel, divides_a_stretch_into_equal_steps) {
  PlasmaModel<2> model = open_model();
  model.advance_by(0.1);
  EXPECT_EQ(model.observe().steps, 2);
  model.advance_by(0.12);
  EXPECT_EQ(model.observe().steps, 5);
  EXPECT_NEAR(model.time(), 0.22, 1e-14);
}

TEST(PlasmaModel, names_what_it_cannot_do) {
  PlasmaModel<2> model(open_channel(10), fluid, StageOptions{}, 0.05);
  EXPECT_THROW(model.advance(profile_of(1), until_steady), ParameterError);
  PlasmaModel<2> channel = open_model();
  EXPECT_THROW(channel.advance({}, until_steady), ParameterError);
  EXPECT_THROW(channel.advance_by(0), ParameterError);
  EXPECT_THROW(PlasmaModel<2>(open_channel(10), fluid, StageOptions{}, 0), ParameterError);
  EXPECT_THROW(
      PlasmaModel<2>(open_channel(10), {.density = 0, .kinematic_viscosity = 1}, StageOptions{}, 1),
      ParameterError);
}

TEST(InletFlux, a_uniform_inlet_carries_the_wanted_flux) {
  for (const double ratio : {2.5, 3.1}) {
    for (const int rows : {8, 16, 30}) {
      StageOptions options;
      options.inertia = Inertia::quasi_steady;
      options.kernel_ratio = ratio;
      const double factor = uniform_inlet_factor(options, rows);
      EXPECT_GT(factor, 1);
      FlowDomain<2> domain = channel_nodes(3, 1, false, {.spacing = 1.0 / rows});
      domain.patches[inlet_patch].velocity = [factor](const Vector<2>&, double) {
        return Vector<2>(factor, 0);
      };
      PlasmaModel<2> model(std::move(domain), fluid, options, 1,
                           ChannelSections{.height = 1, .upstream = 1.5, .downstream = 2.5});
      model.advance_by(1);
      EXPECT_NEAR(model.observe().flow_rate_upstream, 1, 1e-3) << ratio << ' ' << rows;
    }
  }
}

}  // namespace
}  // namespace hemoscale::micro
