#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "micro/error.hpp"
#include "micro/mps/stage_limits.hpp"
#include "micro/random/philox.hpp"
#include "tests/support/mps/flows.hpp"

namespace hemoscale::micro {
namespace {

using testing::HasSubstr;
using namespace test;

constexpr Fluid fluid{.density = 1, .kinematic_viscosity = 1};

StageOptions explicit_options(double ratio) {
  StageOptions options;
  options.viscosity = ViscosityTreatment::explicit_euler;
  options.coupling = PressureCoupling::incremental;
  options.time_scheme = TimeScheme::euler;
  options.kernel_ratio = ratio;
  return options;
}

double viscous_step(const StageOptions& options, double spacing) {
  for (const Limit& limit : stage_limits<2>(options, fluid, spacing, 1, {})) {
    if (limit.name == "viscous limit") return limit.limit;
  }
  return 0;
}

/// A periodic box with a little noise, stepped at a share of the viscous limit.
StageStepper<2> noisy_box(double ratio, double disorder) {
  FlowDomain<2> domain =
      periodic_nodes<2>({1, 1}, {.spacing = 1.0 / 16, .disorder = disorder, .seed = 6});
  for (std::size_t i = 0; i < domain.particles.size(); ++i) {
    for (int axis = 0; axis < 2; ++axis) {
      domain.particles.velocities[i][axis] =
          1e-3 *
          (uniform({.seed = 9, .stream = static_cast<std::uint64_t>(axis), .counter = i}) - 0.5);
    }
  }
  return {std::move(domain), fluid, explicit_options(ratio)};
}

TEST(StageLimits, explicit_viscosity_is_stable_below_and_unstable_above_the_limit) {
  for (const double ratio : {2.1, 2.5, 3.1, 4.1}) {
    for (const double disorder : {0.0, 0.05}) {
      const double limit = viscous_step(explicit_options(ratio), 1.0 / 16);
      StageStepper<2> below = noisy_box(ratio, disorder);
      for (int k = 0; k < 300; ++k) below.step(0.9 * limit);
      EXPECT_LT(below.report().largest_speed, 1e-3)
          << "ratio " << ratio << ", disorder " << disorder;

      StageStepper<2> above = noisy_box(ratio, disorder);
      try {
        for (int k = 0; k < 600; ++k) above.step(1.1 * limit);
        FAIL() << "stable above the limit, ratio " << ratio << ", disorder " << disorder;
      } catch (const NumericalError& error) {
        EXPECT_THAT(error.what(), HasSubstr("viscous limit"));
        EXPECT_THAT(error.what(), HasSubstr("step "));
      }
    }
  }
}

TEST(StageLimits, implicit_viscosity_has_none) {
  StageOptions options = explicit_options(2.5);
  options.viscosity = ViscosityTreatment::implicit;
  EXPECT_EQ(viscous_step(options, 1.0 / 16), 0);
}

TEST(StageLimits, advection_past_resting_nodes_is_stable_at_its_limit_and_fails_far_beyond) {
  StageOptions options;
  options.coupling = PressureCoupling::incremental;
  EXPECT_LT(vortex_error(16, 1.0, options), 0.05);
  StageStepper<2> fast(forced_channel(8), fluid, options);
  try {
    fast.step(1);  // twelve spacings
    FAIL() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("advection is explicit"));
  }
}

TEST(StageLimits, limits_are_those_of_the_choices) {
  StageOptions options;
  const auto names = [&](const FlowScales& scales) {
    std::string text;
    for (const Limit& limit : stage_limits<2>(options, fluid, 0.1, 1, scales)) {
      text += limit.name + ";";
    }
    return text;
  };
  EXPECT_EQ(names({}), "");
  EXPECT_EQ(names({.speed = 1}), "advective limit;");
  options.inertia = Inertia::quasi_steady;
  EXPECT_EQ(names({.speed = 1}), "");
  options = {};
  options.coupling = PressureCoupling::chorin;
  EXPECT_EQ(names({.speed = 1, .gap = 1}), "advective limit;splitting error;");
}

TEST(StageOptions, names_all_choices_that_exclude_each_other) {
  StageOptions options;
  options.inertia = Inertia::quasi_steady;
  options.coupling = PressureCoupling::incremental;
  options.viscosity = ViscosityTreatment::explicit_euler;
  options.shifting = Shifting::concentration;
  options.kernel_ratio = 1;
  try {
    check(options);
    FAIL() << "no error";
  } catch (const ParameterError& error) {
    for (const char* part :
         {"quasi-steady flow needs the coupled solver",
          "quasi-steady flow needs implicit viscosity", "explicit viscosity is stepped by Euler",
          "resting nodes need no shifting", "the kernel ratio is 1"}) {
      EXPECT_THAT(error.what(), HasSubstr(part));
    }
  }
}

TEST(StageStepper, a_velocity_that_is_not_finite_is_named_and_the_last_state_kept) {
  FlowDomain<2> domain = forced_channel(8);
  bool broken = false;
  domain.acceleration = [&broken](double) {
    return Vector<2>(broken ? std::numeric_limits<double>::quiet_NaN() : 12, 0);
  };
  StageStepper<2> stepper(std::move(domain), fluid, {});
  stepper.step(0.1);
  const auto good = stepper.particles().velocities;
  broken = true;
  try {
    stepper.step(0.1);
    FAIL() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("step 2, time 0.2 s"));
    EXPECT_THAT(error.what(), HasSubstr("nan"));
  }
  EXPECT_EQ(stepper.particles().velocities, good);
  EXPECT_EQ(stepper.steps(), 1);
  broken = false;
  EXPECT_NO_THROW(stepper.step(0.1));
}

TEST(StageStepper, a_particle_that_crosses_a_wall_is_named) {
  FlowDomain<2> domain = forced_channel(8);
  // Pushed towards the wall faster than the wall can stop it within a step of Lagrangian motion.
  for (std::size_t i = 0; i < domain.particles.size(); ++i) {
    if (domain.particles.kinds[i] == ParticleKind::fluid) domain.particles.velocities[i] = {0, 3};
  }
  StageOptions options;
  options.motion = NodeMotion::lagrangian;
  StageStepper<2> stepper(std::move(domain), {.density = 1, .kinematic_viscosity = 1e-3}, options);
  try {
    for (int k = 0; k < 20; ++k) stepper.step(0.06);
    FAIL() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(),
                testing::AnyOf(HasSubstr("crossed the wall"), HasSubstr("from another"),
                               HasSubstr("moment matrix")));
    EXPECT_THAT(error.what(), HasSubstr("particle "));
  }
}

TEST(StageStepper, a_solve_that_does_not_converge_is_named) {
  StageOptions options;
  options.coupling = PressureCoupling::incremental;
  options.linear_solver = LinearSolverKind::aggregate;
  options.tolerance = {.relative_residual = 1e-13, .maximum_iterations = 1};
  StageStepper<2> stepper(forced_channel(8, 0.2), fluid, options);
  try {
    for (int k = 0; k < 3; ++k) stepper.step(1);
    FAIL() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("step 1"));
    EXPECT_THAT(error.what(), HasSubstr("iteration"));
  }
}

}  // namespace
}  // namespace hemoscale::micro
