#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/immersed/implicit_runs.hpp"

// A circle of kept area that hardly bends nor stretches is a rigid disc, free of force and torque,
// whatever is inside. References: converged spectral solutions of the disc between plates made for
// this project, period eight times the width.
namespace hemoscale::micro {
namespace {

using namespace test;

constexpr double height = 10 * micron;
constexpr double speed = 1e-3;

struct Motion {
  double speed, rate, drop, sideways;  // over U, U / H, mu U / H, U
};

struct Disc {
  double confinement = 0.3;  // diameter over height
  double place = 0;          // off the axis, over the height
  double ratio = 1;
  double rows = 20;
};

Motion motion_of(const Disc& disc) {
  const CellPlan plan{.nodes = 60,
                      .stretch_modulus = 1,
                      .bending_modulus = 1e-12,
                      .viscosity_ratio = disc.ratio,
                      .centre = {40 * micron, (0.5 + disc.place) * height}};
  ImplicitMembranes membranes(kept_channel(80 * micron, height, height / disc.rows, speed),
                              {cell_of(circle(disc.confinement * height / 2, plan.nodes), plan)},
                              {.longest_step = 1e-5, .step_tolerance = 0, .sweep_tolerance = 1e-6});
  membranes.advance_by(5e-5);
  const Seen seen = look_at(membranes);
  return {seen.motion.velocity.x() / speed, seen.motion.rigid_rate * height / speed,
          MembraneFlow(membranes).extra_pressure_drop() * height / (water.viscosity() * speed),
          seen.motion.velocity.y() / speed};
}

TEST(RigidDisc, on_the_axis_has_the_known_speed_and_resistance) {
  struct Known {
    double confinement, speed, drop;
  };
  for (const Known& known : {Known{0.3, 1.435006, 0.11583}, Known{0.5, 1.331998, 0.95619},
                             Known{0.7, 1.203365, 4.51707}}) {
    const Motion motion = motion_of({.confinement = known.confinement});
    EXPECT_NEAR(motion.speed, known.speed, 5e-4 * known.speed) << known.confinement;
    EXPECT_NEAR(motion.drop, known.drop, 5e-3 * known.drop) << known.confinement;
    EXPECT_NEAR(motion.rate, 0, 1e-5);
    EXPECT_NEAR(motion.sideways, 0, 1e-5);
  }
}

TEST(RigidDisc, feels_nothing_of_what_is_inside) {
  const Motion motion = motion_of({.confinement = 0.5, .place = 0.1, .ratio = 5});
  const Motion other = motion_of({.confinement = 0.5, .place = 0.1, .ratio = 1});
  EXPECT_NEAR(motion.speed, other.speed, 1e-4);
  EXPECT_NEAR(motion.rate, other.rate, 1e-4);
  EXPECT_NEAR(motion.drop, other.drop, 1e-3 * other.drop);
}

TEST(RigidDisc, off_the_axis_turns_at_the_known_rate_and_does_not_drift) {
  struct Known {
    double place, speed, rate;
  };
  for (const Known& known :
       {Known{0.1, 1.37166, 0.56749}, Known{0.2, 1.17007, 1.10543}, Known{0.25, 1.00199, 1.3241}}) {
    const Motion motion = motion_of({.place = known.place});
    EXPECT_NEAR(motion.speed, known.speed, 5e-4 * known.speed) << known.place;
    EXPECT_NEAR(motion.rate, known.rate, 5e-3 * known.rate) << known.place;
    EXPECT_NEAR(motion.sideways, 0, 1e-4) << known.place;
  }
}

TEST(RigidDisc, converges_with_the_spacing_of_the_plasma) {
  const Motion coarse = motion_of({.confinement = 0.7, .rows = 10});
  const Motion middle = motion_of({.confinement = 0.7, .rows = 20});
  const Motion fine = motion_of({.confinement = 0.7, .rows = 40});
  EXPECT_LT(std::abs(middle.speed - 1.203365), std::abs(coarse.speed - 1.203365));
  EXPECT_LT(std::abs(middle.drop - 4.51707), std::abs(coarse.drop - 4.51707));
  EXPECT_LT(std::abs(fine.speed - 1.203365), 0.3 * std::abs(coarse.speed - 1.203365));
  EXPECT_LT(std::abs(fine.drop - 4.51707), 0.3 * std::abs(coarse.drop - 4.51707));
}

}  // namespace
}  // namespace hemoscale::micro
