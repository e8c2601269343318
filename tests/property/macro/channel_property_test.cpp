#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "macro/analytic/channel_model.hpp"
#include "tests/property/macro/random_numbers.hpp"

namespace hemoscale::macro {
namespace {

ViscosityLaw random_law(RandomNumbers& numbers) {
  const double mu = numbers.log_between(1e-3, 1e-2);
  const double choice = numbers.between(0, 6);
  if (choice < 1) return Newtonian{mu};
  if (choice < 2) {
    return CarreauYasuda{mu * numbers.log_between(1, 50), mu, numbers.log_between(0.01, 10),
                         numbers.between(0.2, 1), numbers.between(0.5, 4)};
  }
  if (choice < 3) return Casson{numbers.log_between(1e-3, 1e-2), mu, numbers.log_between(1e-6, 1)};
  if (choice < 4) {
    return Cross{mu * numbers.log_between(1, 50), mu, numbers.log_between(0.01, 10),
                 numbers.between(0.3, 0.95)};
  }
  if (choice < 5) return PowerLaw{mu, numbers.between(0.3, 1.6), 1e-4, 1e5};
  return quemada_cokelet(1.2e-3, 0.4);
}

TEST(ChannelProperty, both_drives_describe_the_same_flow) {
  RandomNumbers numbers(31);
  for (int trial = 0; trial < 200; ++trial) {
    const ViscosityLaw law = random_law(numbers);
    const double height = numbers.log_between(1e-5, 1e-2);
    const double velocity = height * numbers.log_between(1e-2, 1e4);
    const auto by_velocity =
        ChannelModel<2>(Channel{height, 0.4, MeanVelocity{velocity}}).solve(law);
    const double G = by_velocity->pressure_gradient();
    const auto by_pressure = ChannelModel<2>(Channel{height, 0.4, PressureGradient{G}}).solve(law);
    ASSERT_NEAR(by_velocity->mean_velocity() / velocity, 1, 1e-12) << law.name() << trial;
    ASSERT_NEAR(by_pressure->mean_velocity() / velocity, 1, 1e-10) << law.name() << trial;
    const double y = numbers.between(0, height);
    ASSERT_NEAR(by_pressure->velocity(y), by_velocity->velocity(y), 1e-10 * velocity)
        << law.name() << trial;
  }
}

TEST(ChannelProperty, velocity_and_stress_fall_from_axis_to_wall_and_from_wall_to_axis) {
  RandomNumbers numbers(32);
  for (int trial = 0; trial < 100; ++trial) {
    const ViscosityLaw law = random_law(numbers);
    const double height = numbers.log_between(1e-5, 1e-2);
    const auto flow =
        ChannelModel<2>(Channel{height, 0.4, MeanVelocity{height * numbers.log_between(0.1, 1e3)}})
            .solve(law);
    double velocity = 0;
    double shear_rate = flow->wall_shear_rate();
    for (int i = 1; i <= 100; ++i) {
      const double y = 0.5 * height * i / 100.0;
      ASSERT_GE(flow->velocity(y), velocity * (1 - 1e-14)) << law.name() << trial;
      ASSERT_LT(flow->shear_rate(y), shear_rate) << law.name() << trial;
      velocity = flow->velocity(y);
      shear_rate = flow->shear_rate(y);
    }
    // Between plug flow and the limit of an infinitely thickening fluid, a triangle.
    ASSERT_GE(velocity / flow->mean_velocity(), 1) << law.name() << trial;
    ASSERT_LE(velocity / flow->mean_velocity(), 2) << law.name() << trial;
  }
}

// With lengths times a, times 1: velocities scale with a at equal stress.
TEST(ChannelProperty, velocities_scale_with_the_height_at_equal_wall_stress) {
  RandomNumbers numbers(33);
  for (int trial = 0; trial < 100; ++trial) {
    const ViscosityLaw law = random_law(numbers);
    const double G = numbers.log_between(1e3, 1e5);
    const auto small = ChannelModel<2>(Channel{1e-4, 0.4, PressureGradient{G}}).solve(law);
    const auto large = ChannelModel<2>(Channel{8e-4, 0.4, PressureGradient{G / 8}}).solve(law);
    ASSERT_NEAR(large->mean_velocity() / (8 * small->mean_velocity()), 1, 1e-12) << law.name();
    ASSERT_NEAR(large->velocity(2e-4) / (8 * small->velocity(0.25e-4)), 1, 1e-12) << law.name();
  }
}

}  // namespace
}  // namespace hemoscale::macro
