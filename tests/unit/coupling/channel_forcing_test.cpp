#include "coupling/transfer/channel_forcing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "coupling/error.hpp"
#include "macro/analytic/poiseuille.hpp"
#include "micro/mps/node_domains.hpp"
#include "micro/mps/plasma_model.hpp"

namespace hemoscale::coupling {
namespace {

/// Plane Poiseuille flow that runs along an oblique axis from a point.
class Oblique final : public macro::FlowField<2> {
 public:
  Oblique(double angle, macro::Vector<2> corner) : angle_(angle), corner_(std::move(corner)) {}
  std::optional<macro::FlowState<2>> at(const macro::Vector<2>& x, double) const override {
    const macro::Vector<2> along(std::cos(angle_), std::sin(angle_));
    const macro::Vector<2> up(-along[1], along[0]);
    const double y = (x - corner_).dot(up);
    if (y < -1e-12 || y > 2 + 1e-12) return std::nullopt;
    macro::FlowState<2> state;
    state.velocity = y * (2 - y) * along;
    return state;
  }

 private:
  double angle_;
  macro::Vector<2> corner_;
};

TEST(ChannelForcing, takes_the_profile_across_an_oblique_channel) {
  const double angle = 0.6;
  const macro::Vector<2> corner(3, -1);
  const macro::Vector<2> up(-std::sin(angle), std::cos(angle));
  const Oblique flow(angle, corner);
  const auto result = to_channel_forcing(flow, {.lower = corner, .upper = corner + 2 * up}, 0);
  ASSERT_TRUE(result.forcing.profile);
  EXPECT_NEAR(result.forcing.profile->height, 2, 1e-12);
  ASSERT_EQ(result.forcing.profile->velocities.size(), 33U);
  EXPECT_NEAR(result.forcing.profile->velocities[16], 1, 1e-12);
  EXPECT_NEAR(result.forcing.profile->velocities[8], 0.75, 1e-12);
  EXPECT_NEAR(result.transverse, 0, 1e-12);
}

TEST(ChannelForcing, tells_what_flows_along_the_section) {
  const Oblique flow(0, {0, 0});
  const auto result = to_channel_forcing(flow, {.lower = {0, 0}, .upper = {2, 2}}, 0);
  EXPECT_NEAR(result.transverse, 1, 1e-12);
  EXPECT_NEAR(result.forcing.profile->velocities[16], std::sqrt(0.5), 1e-12);
}

TEST(ChannelForcing, refuses_sections_that_make_no_inlet) {
  const Oblique flow(0, {0, 0});
  EXPECT_THROW(to_channel_forcing(flow, {.lower = {0, 0}, .upper = {0, 0}}, 0), NumericalError);
  EXPECT_THROW(to_channel_forcing(flow, {.lower = {0, 0}, .upper = {0, 2}, .points = 3}, 0),
               NumericalError);
  EXPECT_THROW(to_channel_forcing(flow, {.lower = {0, 0}, .upper = {0, 2.1}}, 0), NumericalError);
  EXPECT_THROW(to_channel_forcing(flow, {.lower = {0, 0}, .upper = {4, 0}}, 0), NumericalError);
}

TEST(ChannelForcing, macro_flow_drives_a_plasma_whose_answer_is_that_of_the_macro_flow) {
  // From the macro scale down, and back: flow rate, pressure drop and wall stress.
  const double height = 10e-6;
  const double viscosity = 1e-3;
  const double gradient = 1.2e6;  // Pa/m: mean velocity 10 mm/s
  const macro::PlanePoiseuille<2> flow({height, gradient, viscosity});
  const auto down = to_channel_forcing(flow, {.lower = {0, 0}, .upper = {0, height}}, 0);

  micro::StageOptions options;
  options.inertia = micro::Inertia::quasi_steady;
  micro::PlasmaModel<2> plasma(
      micro::channel_nodes(30e-6, height, false, {.spacing = 1e-6}),
      {.density = 1000, .kinematic_viscosity = 1e-6}, options, 1e-3,
      micro::ChannelSections{.height = height, .upstream = 10e-6, .downstream = 20e-6});
  const micro::Observation<2> up = plasma.advance(
      down.forcing, {.minimum_strain = 1, .maximum_strain = 10, .relative_standard_error = 1e-9});
  ASSERT_TRUE(up.channel);
  EXPECT_NEAR(up.channel->flow_rate / 1e-7, 1, 1e-6);
  EXPECT_NEAR(up.channel->pressure_drop / (gradient * 10e-6), 1, 1e-6);
  EXPECT_NEAR(up.channel->wall_shear_stress / (gradient * height / 2), 1, 1e-6);
}

}  // namespace
}  // namespace hemoscale::coupling
