#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "macro/analytic/channel_model.hpp"
#include "macro/analytic/couette.hpp"
#include "macro/analytic/poiseuille.hpp"
#include "macro/analytic/start_up.hpp"
#include "macro/analytic/womersley.hpp"

namespace hemoscale::macro {
namespace {

constexpr double h = 80e-6;    // [m]
constexpr double mu = 3.5e-3;  // [Pa s]
constexpr double rho = 1060;   // [kg/m^3]
constexpr double G = 4e4;      // [Pa/m]
constexpr double time = 3e-4;  // [s] about 0.15 h^2 / nu

template <int dim>
struct Named {
  std::string name;
  std::shared_ptr<const FlowField<dim>> flow;
};

template <int dim>
std::vector<Named<dim>> channel_flows() {
  const ChannelModel<dim> model(Channel{h, 0.4, PressureGradient{G}});
  return {
      {"poiseuille", std::make_shared<PlanePoiseuille<dim>>(PlanePoiseuilleProfile{h, G, mu})},
      {"couette", std::make_shared<PlaneCouette<dim>>(PlaneCouetteProfile{h, 2e-3})},
      {"start_up_poiseuille",
       std::make_shared<StartUpPoiseuille<dim>>(StartUpPoiseuilleProfile{h, G, mu, rho})},
      {"start_up_couette",
       std::make_shared<StartUpCouette<dim>>(StartUpCouetteProfile{h, 2e-3, mu, rho})},
      {"womersley", std::make_shared<WomersleyChannel<dim>>(
                        WomersleyChannelProfile{h, 0.3 * G, G, 5e3, mu, rho})},
      {"carreau", model.solve(cho_kensey_1991())},
  };
}

TEST(PlaneFlows, are_empty_outside_the_channel_and_defined_on_its_walls) {
  for (const auto& [name, flow] : channel_flows<2>()) {
    EXPECT_TRUE(flow->at({0, 0}, time).has_value()) << name;
    EXPECT_TRUE(flow->at({-3, h}, time).has_value()) << name;
    EXPECT_FALSE(flow->at({0, -1e-12}, time).has_value()) << name;
    EXPECT_FALSE(flow->at({0, h * (1 + 1e-12)}, time).has_value()) << name;
    EXPECT_FALSE(flow->at({0, std::nan("")}, time).has_value()) << name;
  }
}

TEST(PlaneFlows, do_not_depend_on_z_and_are_equal_in_two_and_three_dimensions) {
  const auto plane = channel_flows<2>();
  const auto space = channel_flows<3>();
  for (std::size_t i = 0; i < plane.size(); ++i) {
    const FlowState<2> in_plane = *plane[i].flow->at({7e-6, 0.3 * h}, time);
    const FlowState<3> in_space = *space[i].flow->at({7e-6, 0.3 * h, 42}, time);
    EXPECT_EQ(in_space.velocity.head<2>(), in_plane.velocity) << plane[i].name;
    EXPECT_EQ(in_space.velocity[2], 0) << plane[i].name;
    EXPECT_EQ((in_space.velocity_gradient.topLeftCorner<2, 2>()), in_plane.velocity_gradient)
        << plane[i].name;
    EXPECT_EQ(in_space.velocity_gradient.col(2).norm(), 0) << plane[i].name;
    EXPECT_EQ(in_space.pressure, in_plane.pressure) << plane[i].name;
  }
}

// L(i,j) = d u_i / d x_j: only (0, 1) is filled, never (1, 0).
TEST(PlaneFlows, store_the_gradient_with_the_component_first) {
  for (const auto& [name, flow] : channel_flows<2>()) {
    const FlowState<2> state = *flow->at({0, 0.2 * h}, time);
    EXPECT_NE(state.velocity_gradient(0, 1), 0) << name;
    EXPECT_EQ(state.velocity_gradient(1, 0), 0) << name;
    EXPECT_EQ(state.velocity_gradient(0, 0), 0) << name;
    EXPECT_EQ(state.velocity_gradient(1, 1), 0) << name;
  }
}

TEST(PlaneFlows, sample_answers_point_by_point) {
  const PlanePoiseuille<2> flow({h, G, mu});
  const auto states = flow.sample({{0, 0.5 * h}, {0, 2 * h}, {0, 0.25 * h}}, 0);
  ASSERT_EQ(states.size(), 3U);
  EXPECT_EQ(states[0]->velocity, flow.at({0, 0.5 * h}, 0)->velocity);
  EXPECT_FALSE(states[1].has_value());
  EXPECT_EQ(states[2]->velocity, flow.at({0, 0.25 * h}, 0)->velocity);
}

TEST(PlanePoiseuille, has_its_known_figures) {
  const PlanePoiseuille<2> flow({h, G, mu});
  EXPECT_NEAR(flow.at({0, 0.5 * h}, 0)->velocity[0], G * h * h / (8 * mu), 1e-15);
  EXPECT_NEAR(flow.at({0, 0}, 0)->velocity_gradient(0, 1), G * h / (2 * mu), 1e-9);
  EXPECT_NEAR(flow.at({0, h}, 0)->velocity_gradient(0, 1), -G * h / (2 * mu), 1e-9);
  EXPECT_EQ(flow.at({0, 0}, 0)->velocity[0], 0);
  EXPECT_EQ(flow.at({0, h}, 0)->velocity[0], 0);
  EXPECT_NEAR(flow.at({1e-3, 0}, 0)->pressure, -G * 1e-3, 1e-12);
}

TEST(PipePoiseuille, has_its_known_figures) {
  const double R = 40e-6;
  const PipePoiseuille flow({R, G, mu});
  EXPECT_NEAR(flow.at({0, 0, 0}, 0)->velocity[0], G * R * R / (4 * mu), 1e-15);
  EXPECT_EQ(flow.at({0, 0, 0}, 0)->velocity_gradient.norm(), 0);
  EXPECT_EQ(flow.at({0, R, 0}, 0)->velocity[0], 0);
  const FlowState<3> state = *flow.at({2e-3, 0.3 * R, -0.4 * R}, 0);
  EXPECT_NEAR(state.velocity_gradient(0, 1), -G * 0.3 * R / (2 * mu), 1e-9);
  EXPECT_NEAR(state.velocity_gradient(0, 2), G * 0.4 * R / (2 * mu), 1e-9);
  EXPECT_NEAR(state.pressure, -G * 2e-3, 1e-12);
  EXPECT_FALSE(flow.at({0, 0.8 * R, 0.61 * R}, 0).has_value());
  EXPECT_TRUE(flow.at({0, 0.8 * R, 0.59 * R}, 0).has_value());
}

TEST(PlaneCouette, moves_with_its_walls) {
  const PlaneCouette<3> flow({h, -2e-3});
  EXPECT_EQ(flow.at({0, 0, 0}, 0)->velocity[0], 0);
  EXPECT_EQ(flow.at({0, h, 0}, 0)->velocity[0], -2e-3);
  EXPECT_NEAR(flow.at({0, 0.25 * h, 0}, 0)->velocity[0], -0.5e-3, 1e-18);
  EXPECT_NEAR(flow.at({0, 0.25 * h, 0}, 0)->velocity_gradient(0, 1), -25, 1e-12);
}

TEST(SimpleShear, is_defined_everywhere) {
  const SimpleShear<3> flow(-30);
  const FlowState<3> state = *flow.at({5, -2, 9}, 1);
  EXPECT_EQ(state.velocity, Vector<3>(60, 0, 0));
  EXPECT_EQ(state.velocity_gradient(0, 1), -30);
  EXPECT_EQ(state.velocity_gradient.norm(), 30);
  EXPECT_EQ(state.pressure, 0);
}

TEST(StartUp, fluid_is_at_rest_before_the_start) {
  const StartUpPoiseuille<2> poiseuille({h, G, mu, rho});
  EXPECT_EQ(poiseuille.at({1, 0.5 * h}, -1e-9)->velocity[0], 0);
  EXPECT_EQ(poiseuille.at({1, 0.5 * h}, -1e-9)->pressure, 0);
  EXPECT_EQ(poiseuille.at({1, 0.5 * h}, 0)->velocity[0], 0);
  EXPECT_EQ(poiseuille.at({1, 0.5 * h}, 0)->pressure, -G);
  const StartUpCouette<2> couette({h, 2e-3, mu, rho});
  EXPECT_EQ(couette.at({0, h}, -1)->velocity[0], 0);
  EXPECT_EQ(couette.at({0, h}, 0)->velocity[0], 0);
}

TEST(StartUp, fluid_away_from_the_walls_first_accelerates_freely) {
  const StartUpPoiseuille<2> flow({h, G, mu, rho});
  EXPECT_NEAR(flow.at({0, 0.5 * h}, 1e-6)->velocity[0], G / rho * 1e-6, 1e-15);
}

}  // namespace
}  // namespace hemoscale::macro
