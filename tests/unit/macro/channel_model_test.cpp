#include "macro/analytic/channel_model.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "macro/error.hpp"

namespace hemoscale::macro {
namespace {

constexpr double h = 75e-6;  // [m]

TEST(ChannelModel, fluid_without_drive_is_at_rest) {
  for (const ChannelDrive drive :
       {ChannelDrive(PressureGradient{0}), ChannelDrive(MeanVelocity{0})}) {
    const auto flow = ChannelModel<2>(Channel{h, 0.4, drive}).solve(cho_kensey_1991());
    EXPECT_EQ(flow->velocity(0.3 * h), 0);
    EXPECT_EQ(flow->shear_rate(0.3 * h), 0);
    EXPECT_EQ(flow->wall_shear_rate(), 0);
    EXPECT_EQ(flow->mean_velocity(), 0);
    EXPECT_EQ(flow->flow_rate_per_depth(), 0);
    EXPECT_EQ(flow->pressure_gradient(), 0);
  }
}

TEST(ChannelModel, reversing_the_drive_reverses_the_flow) {
  const auto forward =
      ChannelModel<3>(Channel{h, 0.4, PressureGradient{5e4}}).solve(cho_kensey_1991());
  const auto backward =
      ChannelModel<3>(Channel{h, 0.4, PressureGradient{-5e4}}).solve(cho_kensey_1991());
  EXPECT_GT(forward->mean_velocity(), 0);
  EXPECT_EQ(backward->mean_velocity(), -forward->mean_velocity());
  EXPECT_EQ(backward->pressure_gradient(), -5e4);
  const Vector<3> x(1e-3, 0.2 * h, 1);
  EXPECT_EQ(backward->at(x, 0)->velocity, -forward->at(x, 0)->velocity);
  EXPECT_EQ(backward->at(x, 0)->velocity_gradient, -forward->at(x, 0)->velocity_gradient);
  EXPECT_EQ(backward->at(x, 0)->pressure, -forward->at(x, 0)->pressure);
  EXPECT_EQ(backward->shear_rate(0.2 * h), forward->shear_rate(0.2 * h));
}

TEST(ChannelModel, fluid_at_the_walls_rests_exactly) {
  const auto flow = ChannelModel<2>(Channel{h, 0.4, MeanVelocity{2e-3}}).solve(cho_kensey_1991());
  EXPECT_EQ(flow->velocity(0), 0);
  EXPECT_EQ(flow->velocity(h), 0);
  EXPECT_EQ(flow->shear_rate(0), flow->wall_shear_rate());
  EXPECT_EQ(flow->shear_rate(0.5 * h), 0);
}

TEST(ChannelModel, gradient_is_positive_at_the_lower_wall_and_negative_at_the_upper) {
  const auto flow = ChannelModel<2>(Channel{h, 0.4, MeanVelocity{2e-3}}).solve(cho_kensey_1991());
  EXPECT_EQ(flow->at({0, 0}, 0)->velocity_gradient(0, 1), flow->wall_shear_rate());
  EXPECT_EQ(flow->at({0, h}, 0)->velocity_gradient(0, 1), -flow->wall_shear_rate());
  EXPECT_EQ(flow->at({0, 0.5 * h}, 0)->velocity_gradient.norm(), 0);
}

TEST(ChannelModel, is_symmetric_about_the_axis) {
  const auto flow = ChannelModel<2>(Channel{h, 0.4, MeanVelocity{2e-3}}).solve(cho_kensey_1991());
  EXPECT_NEAR(flow->velocity(0.125 * h), flow->velocity(0.875 * h), 1e-18);
}

TEST(ChannelModel, an_answer_stays_valid_after_later_calls) {
  ChannelModel<2> model(Channel{h, 0.4, PressureGradient{5e4}});
  const std::shared_ptr<const FlowField<2>> thin = model.advance(Newtonian{1e-3}, {0, 1});
  const double before = thin->at({0, 0.3 * h}, 0)->velocity[0];
  const std::shared_ptr<const FlowField<2>> thick = model.advance(Newtonian{2e-3}, {1, 2});
  EXPECT_EQ(thin->at({0, 0.3 * h}, 0)->velocity[0], before);
  EXPECT_NEAR(thick->at({0, 0.3 * h}, 0)->velocity[0], 0.5 * before, 1e-15 * before);
}

TEST(ChannelModel, uses_its_hematocrit) {
  const ViscosityTable table({{0.2, {1}, {2e-3}}, {0.4, {1}, {8e-3}}});
  const auto mean = [&](double hematocrit) {
    return ChannelModel<2>(Channel{h, hematocrit, PressureGradient{5e4}})
        .solve(table)
        ->mean_velocity();
  };
  EXPECT_NEAR(mean(0.2) / mean(0.4), 4, 1e-12);
}

TEST(ChannelModel, passes_the_refusal_of_a_law_on) {
  const ChannelModel<2> model(Channel{h, 0.55, MeanVelocity{2e-3}});
  EXPECT_THROW(model.solve(Quemada{1.2e-3, 4, 2, 1}), ParameterError);
}

}  // namespace
}  // namespace hemoscale::macro
