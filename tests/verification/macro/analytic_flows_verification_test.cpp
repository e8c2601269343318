// Every analytic flow against the equations it claims to solve, by differences.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <ostream>
#include <string>

#include "macro/analytic/channel_model.hpp"
#include "macro/analytic/couette.hpp"
#include "macro/analytic/poiseuille.hpp"
#include "macro/analytic/start_up.hpp"
#include "macro/analytic/womersley.hpp"
#include "tests/property/macro/random_numbers.hpp"

namespace hemoscale::macro {
namespace {

constexpr double h = 80e-6;                          // [m] height, or radius of a pipe
constexpr double mu = 3.5e-3;                        // [Pa s]
constexpr double rho = 1060;                         // [kg/m^3]
constexpr double G = 4e4;                            // [Pa/m]
constexpr double diffusion_time = rho * h * h / mu;  // [s]

struct Subject {
  std::string name;
  std::shared_ptr<const FlowField<3>> flow;
  bool is_pipe = false;
  double earliest = 0;    // [s] of the times to test
  double latest = 0;      // [s]
  double layer = h;       // [m] shortest length over which the flow changes
  double time_scale = 1;  // [s] shortest time over which the flow changes
};

void PrintTo(const Subject& subject, std::ostream* out) {
  *out << subject.name;
}

class EveryFlow : public testing::TestWithParam<Subject> {
 protected:
  // A point whose neighbourhood of `margin` lies inside the flow.
  Vector<3> point_inside(double margin) {
    const double x = numbers.between(-h, h);
    if (!GetParam().is_pipe)
      return {x, numbers.between(margin, h - margin), numbers.between(-h, h)};
    const double r = numbers.between(margin, h - 2 * margin);
    const double angle = numbers.between(0, 6.28);
    return {x, r * std::cos(angle), r * std::sin(angle)};
  }
  double some_time() { return numbers.between(GetParam().earliest, GetParam().latest); }

  double velocity(const Vector<3>& x, double t) const {
    return GetParam().flow->at(x, t)->velocity[0];
  }

  RandomNumbers numbers{41};
};

// Fourth-order central differences.
double first(const std::function<double(double)>& f, double d) {
  return (8 * (f(d) - f(-d)) - (f(2 * d) - f(-2 * d))) / (12 * d);
}
double second(const std::function<double(double)>& f, double d) {
  return (16 * (f(d) + f(-d)) - (f(2 * d) + f(-2 * d)) - 30 * f(0)) / (12 * d * d);
}

TEST_P(EveryFlow, gradient_is_the_derivative_of_the_velocity) {
  const double d = 3e-3 * GetParam().layer;
  for (int trial = 0; trial < 100; ++trial) {
    const Vector<3> x = point_inside(2.5 * d);
    const double t = some_time();
    const FlowState<3> state = *GetParam().flow->at(x, t);
    const double scale = std::abs(state.velocity[0]) / GetParam().layer + G * h / mu;
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        const double difference = first(
            [&](double s) {
              return GetParam().flow->at(x + s * Vector<3>::Unit(j), t)->velocity[i];
            },
            d);
        ASSERT_NEAR(state.velocity_gradient(i, j), difference, 1e-9 * scale)
            << "L(" << i << "," << j << ") at y = " << x[1] << ", t = " << t;
      }
    }
  }
}

TEST_P(EveryFlow, momentum_is_balanced) {
  const double d = 1e-2 * GetParam().layer;
  const double dt = 1e-3 * GetParam().time_scale;
  for (int trial = 0; trial < 100; ++trial) {
    const Vector<3> x = point_inside(2.5 * d);
    const double t = some_time();
    const auto moved = [&](int j) {
      return [this, x, j, t](double s) { return velocity(x + s * Vector<3>::Unit(j), t); };
    };
    const double laplacian = second(moved(0), d) + second(moved(1), d) + second(moved(2), d);
    const double acceleration = first([&](double s) { return velocity(x, t + s); }, dt);
    const double pressure_gradient = first(
        [&](double s) { return GetParam().flow->at(x + s * Vector<3>::Unit(0), t)->pressure; }, h);
    const double residual = rho * acceleration + pressure_gradient - mu * laplacian;
    const double scale =
        G + rho * std::abs(velocity(x, t)) / GetParam().time_scale + mu * std::abs(laplacian);
    ASSERT_NEAR(residual, 0, 1e-6 * scale) << "y = " << x[1] << ", t = " << t;
  }
}

TEST_P(EveryFlow, is_divergence_free_and_has_no_transverse_velocity) {
  for (int trial = 0; trial < 20; ++trial) {
    const FlowState<3> state = *GetParam().flow->at(point_inside(0), some_time());
    EXPECT_EQ(state.velocity_gradient.trace(), 0);
    EXPECT_EQ(state.velocity.tail<2>().norm(), 0);
  }
}

TEST_P(EveryFlow, fluid_rests_at_the_lower_wall_or_the_pipe) {
  const double centre =
      std::abs(velocity({0, GetParam().is_pipe ? 0 : 0.5 * h, 0}, GetParam().latest));
  for (int trial = 0; trial < 20; ++trial) {
    const double t = some_time();
    const Vector<3> wall = GetParam().is_pipe ? Vector<3>(0, 0, -h) : Vector<3>(0, 0, 0);
    EXPECT_NEAR(velocity(wall, t), 0, 1e-13 * centre);
  }
}

Subject steady(const std::string& name, std::shared_ptr<const FlowField<3>> flow, bool is_pipe) {
  return {name, std::move(flow), is_pipe, 0, 1, h, 1};
}

Subject start_up(const std::string& name, std::shared_ptr<const FlowField<3>> flow, double earliest,
                 double latest) {
  const double begin = earliest * diffusion_time;
  return {name, std::move(flow), false, begin, latest * diffusion_time, h * std::sqrt(earliest),
          begin};
}

template <typename Flow, typename Profile>
Subject womersley(const std::string& name, double alpha, double half_width, Profile profile,
                  bool is_pipe) {
  profile.angular_frequency = alpha * alpha * mu / (rho * half_width * half_width);
  const double period = 6.283185307179586 / profile.angular_frequency;
  return {name,   std::make_shared<Flow>(profile),   is_pipe, 0,
          period, half_width / std::max(1.0, alpha), period};
}

Subject womersley_channel(const std::string& name, double alpha) {
  return womersley<WomersleyChannel<3>>(name, alpha, 0.5 * h,
                                        WomersleyChannelProfile{h, 0.4 * G, G, 0, mu, rho}, false);
}
Subject womersley_pipe(const std::string& name, double alpha) {
  return womersley<WomersleyPipe>(name, alpha, h, WomersleyPipeProfile{h, 0.4 * G, G, 0, mu, rho},
                                  true);
}

std::shared_ptr<const FlowField<3>> start_up_poiseuille() {
  return std::make_shared<StartUpPoiseuille<3>>(StartUpPoiseuilleProfile{h, G, mu, rho});
}
std::shared_ptr<const FlowField<3>> start_up_couette() {
  return std::make_shared<StartUpCouette<3>>(StartUpCouetteProfile{h, 5e-3, mu, rho});
}

INSTANTIATE_TEST_SUITE_P(
    Flows, EveryFlow,
    testing::Values(
        steady("plane_poiseuille",
               std::make_shared<PlanePoiseuille<3>>(PlanePoiseuilleProfile{h, G, mu}), false),
        steady("pipe_poiseuille", std::make_shared<PipePoiseuille>(PipePoiseuilleProfile{h, G, mu}),
               true),
        steady("plane_couette", std::make_shared<PlaneCouette<3>>(PlaneCouetteProfile{h, 5e-3}),
               false),
        steady("simple_shear", std::make_shared<SimpleShear<3>>(30), false),
        steady("channel_model_newtonian",
               ChannelModel<3>(Channel{h, 0.4, PressureGradient{G}}).solve(Newtonian{mu}), false),
        start_up("start_up_poiseuille_early", start_up_poiseuille(), 0.01, 0.04),
        start_up("start_up_poiseuille_late", start_up_poiseuille(), 0.12, 0.4),
        start_up("start_up_couette_early", start_up_couette(), 0.01, 0.04),
        start_up("start_up_couette_late", start_up_couette(), 0.12, 0.4),
        womersley_channel("womersley_channel_slow", 0.3),
        womersley_channel("womersley_channel_middle", 4),
        womersley_channel("womersley_channel_fast", 60), womersley_pipe("womersley_pipe_slow", 0.3),
        womersley_pipe("womersley_pipe_middle", 4),
        womersley_pipe("womersley_pipe_below_hand_over", 17.9),
        womersley_pipe("womersley_pipe_above_hand_over", 18.1),
        womersley_pipe("womersley_pipe_fast", 60)),
    [](const auto& subject) { return subject.param.name; });

// The image sums and the eigenfunction series are independent solutions: they must meet.
TEST(StartUp, early_and_late_formulas_meet_at_the_hand_over) {
  const double before = 0.1 * diffusion_time * (1 - 1e-14);
  const double after = 0.1 * diffusion_time * (1 + 1e-14);
  const auto poiseuille = start_up_poiseuille();
  const auto couette = start_up_couette();
  for (int i = 0; i <= 100; ++i) {
    const double y = h * (i / 100.0);
    for (const auto& flow : {poiseuille, couette}) {
      const FlowState<3> early = *flow->at({0, y, 0}, before);
      const FlowState<3> late = *flow->at({0, y, 0}, after);
      EXPECT_NEAR(early.velocity[0], late.velocity[0], 1e-13 * G * h * h / mu);
      EXPECT_NEAR(early.velocity_gradient(0, 1), late.velocity_gradient(0, 1), 1e-12 * G * h / mu);
    }
  }
}

// The series of the documentation, summed plainly, at times when the images are in use.
TEST(StartUp, early_velocity_is_that_of_the_plain_series) {
  const double pi = std::acos(-1.0);
  const auto poiseuille = start_up_poiseuille();
  const auto couette = start_up_couette();
  for (const double T : {1e-3, 1e-2, 0.09}) {
    for (const double eta : {0.01, 0.2, 0.5, 0.93}) {
      double u = 0.5 * eta * (1 - eta);
      double v = eta;
      for (int k = 1; k < 400; ++k) {
        const double decay = std::exp(-k * k * pi * pi * T) * std::sin(k * pi * eta);
        if (k % 2 == 1) u -= 4 / std::pow(pi * k, 3) * decay;
        v += 2 / (pi * k) * (k % 2 == 0 ? 1 : -1) * decay;
      }
      const Vector<3> x(0, eta * h, 0);
      const double t = T * diffusion_time;
      EXPECT_NEAR(poiseuille->at(x, t)->velocity[0], u * G * h * h / mu, 1e-13 * G * h * h / mu);
      EXPECT_NEAR(couette->at(x, t)->velocity[0], v * 5e-3, 1e-13 * 5e-3);
    }
  }
}

TEST(StartUp, tends_to_the_steady_flow) {
  const PlanePoiseuille<3> poiseuille({h, G, mu});
  const PlaneCouette<3> couette({h, 5e-3});
  const double late = 4 * diffusion_time;
  for (int i = 0; i <= 10; ++i) {
    const double y = h * (i / 10.0);
    const Vector<3> x(0, y, 0);
    EXPECT_NEAR(start_up_poiseuille()->at(x, late)->velocity[0], poiseuille.at(x, 0)->velocity[0],
                1e-15 * G * h * h / mu);
    EXPECT_NEAR(start_up_couette()->at(x, late)->velocity[0], couette.at(x, 0)->velocity[0], 1e-17);
  }
  // Not yet at one fifth of the diffusion time: exp(-pi^2 / 5) is 0.14.
  const Vector<3> axis(0, 0.5 * h, 0);
  EXPECT_LT(start_up_poiseuille()->at(axis, 0.2 * diffusion_time)->velocity[0],
            0.87 * poiseuille.at(axis, 0)->velocity[0]);
}

TEST(StartUp, the_moving_wall_carries_the_fluid) {
  for (const double T : {1e-6, 1e-3, 0.09, 0.2, 3.0}) {
    EXPECT_NEAR(start_up_couette()->at({0, h, 0}, T * diffusion_time)->velocity[0], 5e-3, 1e-17);
  }
}

// Stokes' first problem near the moving wall, long before the other one is felt.
TEST(StartUp, early_couette_is_the_layer_of_a_single_wall) {
  const double t = 1e-4 * diffusion_time;
  const double width = 2 * std::sqrt(mu * t / rho);
  for (const double distance : {0.0, 0.3, 1.0, 3.0}) {
    EXPECT_NEAR(start_up_couette()->at({0, h - distance * width, 0}, t)->velocity[0],
                5e-3 * std::erfc(distance), 1e-15);
  }
}

}  // namespace
}  // namespace hemoscale::macro
