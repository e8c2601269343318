#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "micro/error.hpp"
#include "tests/support/micro/block_laws.hpp"

// Laws of lateral migration: without any, a cell keeps its lateral position; with one, it follows
// the law of its centre, and is not deformed by it.
namespace hemoscale::micro {
namespace {

using test::BlockCase;
using test::Integrator;
using testing::HasSubstr;

constexpr double height = 40e-6;  // [m]

BlockCase channel(double speed = 30e-6) {
  BlockCase c = test::lonely_cell_in_channel();
  c.settings.height = height;
  c.settings.flow = test::parabola(height, speed);
  c.settings.plane_walls = WallPotential{.stiffness = 1, .range = 0.3e-6};
  for (double& y : c.initial.front().y) y -= 14e-6;
  c.settings.time_step = 1e-3;
  return c;
}

double mean_height(const EnsembleState& state) {
  double sum = 0;
  for (const double y : state.y) sum += y;
  return sum / static_cast<double>(state.y.size());
}

TEST(LateralMigration, none_keeps_the_mean_height) {
  for (const Integrator integrator : test::integrators_without_mass) {
    BlockCase c = channel();
    test::set_integrator(c.settings, integrator);
    BlockEnsemble ensemble = c.make(Precision::twofold);
    ensemble.advance(2000);
    EXPECT_NEAR(mean_height(ensemble.states().front()), mean_height(c.initial.front()), 1e-17);
  }
}

TEST(LateralMigration, by_the_lift_of_walls_follows_its_law) {
  BlockCase c = channel();
  const WallLift lift{.coefficient = 2e-17};
  c.settings.migration.wall_lift = lift;
  BlockEnsemble ensemble = c.make(Precision::twofold);
  ensemble.advance(3000);
  double y = mean_height(c.initial.front());
  const double begin = y;
  for (int k = 0; k < 30000; ++k) {
    const double middle = y + 0.5e-4 * lift.velocity(y, height);
    y += 1e-4 * lift.velocity(middle, height);
  }
  EXPECT_GT(y - begin, 0.8e-6);
  EXPECT_NEAR(mean_height(ensemble.states().front()) - begin, y - begin, 1e-3 * (y - begin));
}

TEST(LateralMigration, by_the_similarity_law_follows_its_law_from_both_sides) {
  for (const bool from_above : {false, true}) {
    BlockCase c = channel();
    if (from_above) {
      const double shift = height - 2 * mean_height(c.initial.front());
      for (double& y : c.initial.front().y) y += shift;
    }
    const ShearLift lift{.coefficient = 0.153, .radius = 2.8e-6};
    c.settings.migration.shear_lift = lift;
    BlockEnsemble ensemble = c.make(Precision::twofold);
    ensemble.advance(2000);
    double y = mean_height(c.initial.front());
    const double begin = y;
    for (int k = 0; k < 20000; ++k) {
      const auto rate = [](double h) { return 4 * 30e-6 * (height - 2 * h) / (height * height); };
      const double middle = y + 0.5e-4 * lift.velocity(y, height, rate(y));
      y += 1e-4 * lift.velocity(middle, height, rate(middle));
    }
    EXPECT_GT((from_above ? -1 : 1) * (y - begin), 0.5e-6);
    EXPECT_NEAR(mean_height(ensemble.states().front()) - begin, y - begin,
                2e-3 * std::abs(y - begin));
  }
}

// In a fluid at rest the lift moves a resting cell as a whole.
TEST(LateralMigration, does_not_deform_the_cell) {
  BlockCase c = channel();
  c.settings.flow = std::make_shared<test::NoFlow>();
  c.settings.migration.wall_lift = WallLift{.coefficient = 2e-17};
  BlockEnsemble ensemble = c.make(Precision::single);
  ensemble.advance(1000);
  const auto after = ensemble.states().front();
  const EnsembleState& before = c.initial.front();
  const double shift = mean_height(after) - mean_height(before);
  EXPECT_GT(shift, 0.3e-6);
  for (std::size_t i = 0; i < before.y.size(); ++i) {
    EXPECT_NEAR(after.y[i] - before.y[i], shift, 1e-11);
    EXPECT_NEAR(after.x[i], before.x[i], 1e-11);
  }
}

TEST(LateralMigration, displacement_of_a_walk_has_the_mean_and_variance_of_its_law) {
  const ShearDiffusion walk{.coefficient = 0.5, .radius = 4e-6, .seed = 11};
  const double rate = -20;
  const double slope = 3e7;
  const double dt = 1e-3;
  const double diffusivity = 0.5 * 16e-12 * 20;
  constexpr int draws = 40000;
  double sum = 0;
  double squares = 0;
  for (int k = 0; k < draws; ++k) {
    const double d = walk.displacement(3, static_cast<std::uint64_t>(k), rate, slope, dt);
    sum += d;
    squares += d * d;
  }
  const double mean = sum / draws;
  const double variance = squares / draws - mean * mean;
  const double drift = -0.5 * 16e-12 * slope * dt;  // towards stronger shear
  EXPECT_NEAR(mean, drift, 4 * std::sqrt(2 * diffusivity * dt / draws));
  EXPECT_NEAR(variance, 2 * diffusivity * dt, 4 * std::sqrt(2.0 / draws) * 2 * diffusivity * dt);
}

TEST(LateralMigration, of_a_walk_is_the_same_for_any_threads_and_after_a_restart) {
  BlockCase c = test::crowded_channel();
  c.settings.migration.shear_diffusion =
      ShearDiffusion{.coefficient = 0.01, .radius = 4e-6, .seed = 11};
  c.settings.migration.wall_lift = WallLift{.coefficient = 1e-19};
  const auto run = [&](bool restart) {
    BlockEnsemble ensemble = c.make(Precision::single);
    ensemble.advance(100);
    if (restart) {
      BlockEnsemble other = c.make(Precision::single);
      other.restore(ensemble.snapshot());
      ensemble = std::move(other);
    }
    ensemble.advance(200);
    return ensemble.snapshot();
  };
  const Snapshot usual = run(false);
  EXPECT_EQ(run(true).reals, usual.reals);
  c.settings.threads = 3;
  EXPECT_EQ(run(false).reals, usual.reals);
  c.settings.migration.shear_diffusion->seed = 12;
  EXPECT_NE(run(false).reals, usual.reals);
}

TEST(LateralMigration, is_refused_but_in_plane_channels) {
  BlockCase c = test::shear_box(6);
  c.settings.migration.wall_lift = WallLift{.coefficient = 1e-19};
  try {
    c.make(Precision::single);
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_THAT(error.what(), HasSubstr("plane channels"));
    EXPECT_THAT(error.what(), HasSubstr("switch them off"));
  }
}

TEST(LateralMigration, ends_a_run_whose_cell_has_left_the_channel) {
  BlockCase c = channel();
  c.settings.migration.wall_lift = WallLift{.coefficient = 1e-19};
  for (double& y : c.initial.front().y) y -= 12e-6;
  BlockEnsemble ensemble = c.make(Precision::single);
  EXPECT_THROW(ensemble.advance(10), NumericalError);
}

// Anisotropic drag breaks the conservation of the mean height, the sign depending on the ratio:
// cells in a parabola drift outwards if it is larger across the membrane.
TEST(AnisotropicDrag, moves_a_cell_across_the_flow) {
  const auto drift = [](double ratio) {
    BlockCase c = test::relaxing_cell();
    const double shift = 6e-6 - mean_height(c.initial.front());
    for (double& y : c.initial.front().y) y += shift;
    c.settings.height = 30e-6;
    c.settings.flow = test::parabola(30e-6, 3e-4);
    c.settings.integrator = Integrator::chebyshev;
    c.settings.stages = 10;
    c.settings.time_step = 5e-5;
    c.settings.kinds.front().normal_drag = ratio;
    BlockEnsemble ensemble = c.make(Precision::twofold);
    const double before = mean_height(c.initial.front());
    ensemble.advance(3000);
    return mean_height(ensemble.states().front()) - before;
  };
  EXPECT_LT(std::abs(drift(1)), 1e-17);
  EXPECT_LT(drift(2), -1e-9);
  EXPECT_GT(drift(0.2), 1e-9);
}

}  // namespace
}  // namespace hemoscale::micro
