#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "micro/error.hpp"
#include "micro/mps/lattice_domains_flows.hpp"
#include "micro/mps/reference_density.hpp"
#include "micro/mps/semi_implicit_stepper.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::micro {
namespace {

using testing::HasSubstr;

/// Periodic box of unit spacing whose particles have small random velocities.
FlowDomain<2> noisy_box(double disorder, double noise) {
  FlowDomain<2> domain = lattice_taylor_green<2>({.spacing = 1, .disorder = disorder}, 20, 0);
  for (std::size_t i = 0; i < domain.particles.size(); ++i) {
    domain.particles.velocities[i] = noise * Vector<2>(normal({5, 0, i}), normal({5, 1, i}));
  }
  return domain;
}

/// What the run ended with: the message of its error, or nothing.
std::string end_of(SemiImplicitStepper<2>& stepper, double dt, int steps) {
  try {
    for (int n = 0; n < steps; ++n) stepper.step(dt);
  } catch (const NumericalError& error) {
    return error.what();
  }
  return "";
}

struct ViscousCase {
  double radius, disorder;
};

class ViscousLimit : public testing::TestWithParam<ViscousCase> {
 protected:
  std::string run(double share) const {
    SemiImplicitOptions options;
    options.laplacian_ratio = GetParam().radius;
    options.source = IncompressibilitySource::divergence;
    options.speed = 1e-3;
    options.force = true;
    SemiImplicitStepper<2> stepper(noisy_box(GetParam().disorder, 1e-7),
                                   {.density = 1, .kinematic_viscosity = 1}, options);
    const double limit = viscous_limit<2>(1, 1, 1, GetParam().radius).limit;
    const std::string end = end_of(stepper, share * limit, 150);
    if (share < 1 && end.empty()) {
      EXPECT_LT(stepper.report().fastest, 1e-6);
    }
    return end;
  }
};

INSTANTIATE_TEST_SUITE_P(, ViscousLimit,
                         testing::Values(ViscousCase{2.1, 0}, ViscousCase{3.1, 0},
                                         ViscousCase{4.1, 0}, ViscousCase{2.1, 0.05},
                                         ViscousCase{3.1, 0.05}, ViscousCase{4.1, 0.05}),
                         [](const auto& each) {
                           return std::to_string(std::lround(10 * each.param.radius)) +
                                  (each.param.disorder > 0 ? "_disordered" : "_lattice");
                         });

TEST_P(ViscousLimit, below_it_noise_dies_out) {
  EXPECT_EQ(run(0.9), "");
}

TEST_P(ViscousLimit, beyond_it_the_run_ends_and_names_it) {
  EXPECT_THAT(run(1.1), HasSubstr("viscous limit"));
}

class GainLimit : public testing::TestWithParam<std::pair<double, double>> {
 protected:
  std::string run(double share) const {
    const auto [gradient, laplacian] = GetParam();
    SemiImplicitOptions options;
    options.gradient_ratio = gradient;
    options.laplacian_ratio = laplacian;
    options.relaxation = share * 4 / 3 / density_gain<2>(gradient, laplacian);
    options.speed = 1e-3;
    options.force = true;
    // Waves of two spacings have a slightly negative gain and grow slowly at any relaxation;
    // viscosity holds them down for the length of the run.
    SemiImplicitStepper<2> stepper(noisy_box(0, 1e-8), {.density = 1, .kinematic_viscosity = 0.05},
                                   options, {.relative_residual = 1e-10});
    const std::string end = end_of(stepper, 1, share < 1 ? 150 : 400);
    if (share < 1 && end.empty()) {
      EXPECT_LT(stepper.report().fastest, 1e-4);  // of 2e-2 at which the detector fires
    }
    return end;
  }
};

// With larger radii even the full source is below the limit; here it is at most 6 % beyond.
INSTANTIATE_TEST_SUITE_P(, GainLimit, testing::Values(std::pair{2.1, 3.1}, std::pair{2.1, 4.0}),
                         [](const auto& each) {
                           return std::to_string(std::lround(10 * each.param.first)) + "_" +
                                  std::to_string(std::lround(10 * each.param.second));
                         });

TEST_P(GainLimit, below_it_noise_does_not_grow) {
  EXPECT_EQ(run(0.9), "");
}

TEST_P(GainLimit, beyond_it_the_run_ends_and_names_it) {
  EXPECT_THAT(run(1.05), HasSubstr("number-density gain"));
}

TEST(Limits, are_evaluated_before_the_run_and_refuse_it) {
  SemiImplicitOptions options = paper_literal();
  options.speed = 0.01;
  options.gap = 10e-6;
  const Lattice lattice = {.spacing = 0.5e-6, .disorder = 0.05};
  SemiImplicitStepper<2> stepper(lattice_periodic_channel(lattice, 5e-6, 10e-6, 1),
                                 {.density = 1000, .kinematic_viscosity = 1e-6}, options);
  try {
    stepper.step(5e-7);
    FAIL() << "not refused";
  } catch (const ParameterError& error) {
    EXPECT_THAT(error.what(), HasSubstr("viscous limit: 5e-07 s exceeds 2.498e-07 s"));
    EXPECT_THAT(error.what(), HasSubstr("splitting error: 0.0534"));
    EXPECT_THAT(error.what(), HasSubstr("number-density gain: 1.417"));
    EXPECT_THAT(error.what(), HasSubstr("number-density kick"));
    EXPECT_THAT(error.what(), testing::Not(HasSubstr("advective limit")));
  }
  EXPECT_EQ(stepper.steps(), 0);
  EXPECT_FALSE(advective_limit(4.9e-5, 1e-2, 1e-6).exceeded());
  EXPECT_TRUE(advective_limit(5.1e-5, 1e-2, 1e-6).exceeded());
  EXPECT_TRUE(viscous_limit<2>(std::nan(""), 1, 1, 2.1).exceeded());
  EXPECT_FALSE(viscous_limit<2>(1e9, 0, 1, 2.1).exceeded());
}

TEST(Limits, the_kick_of_a_disordered_start_is_of_the_predicted_size) {
  SemiImplicitOptions options = paper_literal();
  options.relaxation = 0.2;
  options.speed = 1;
  options.force = true;
  SemiImplicitStepper<2> stepper(lattice_taylor_green<2>({.spacing = 1, .disorder = 0.05}, 20, 0),
                                 {.density = 1, .kinematic_viscosity = 0}, options);
  double kick = 0;
  for (const Limit& limit : stepper.limits(1)) {
    if (limit.name == "number-density kick") kick = limit.value;
  }
  stepper.step(1);
  EXPECT_GT(stepper.report().fastest, 0.3 * kick);
  EXPECT_LT(stepper.report().fastest, 5 * kick);
}

SemiImplicitOptions calm_options() {
  SemiImplicitOptions options = best_repaired();
  options.speed = 1;
  return options;
}

TEST(Detectors, name_a_value_that_is_not_finite_and_keep_the_last_good_state) {
  FlowDomain<2> domain = lattice_taylor_green<2>({.spacing = 0.05}, 1, 1);
  domain.acceleration = [](double t) {
    return Vector<2>(t > 0.012 ? std::numeric_limits<double>::quiet_NaN() : 0, 0);
  };
  SemiImplicitOptions options = calm_options();
  options.viscosity = ViscousStepping::explicit_euler;
  SemiImplicitStepper<2> stepper(domain, {.density = 1, .kinematic_viscosity = 0.01}, options);
  stepper.step(5e-3);
  stepper.step(5e-3);
  const Snapshot before = stepper.snapshot();
  EXPECT_THAT(end_of(stepper, 5e-3, 1),
              testing::AllOf(HasSubstr("step 2"), HasSubstr("particle"), HasSubstr("not finite")));
  EXPECT_EQ(stepper.snapshot().reals, before.reals);
  EXPECT_EQ(stepper.steps(), 2);
}

TEST(Detectors, name_a_particle_that_left_the_domain) {
  FlowDomain<2> domain = lattice_rotating_square({.spacing = 0.05}, 1, 0);
  domain.particles.velocities.front() = {-60, -60};
  SemiImplicitOptions options = paper_literal();
  options.relaxation = 0.2;
  options.free_surface_ratio = 0.97;
  options.speed = 100;
  options.force = true;
  SemiImplicitStepper<2> stepper(domain, {.density = 1, .kinematic_viscosity = 0}, options);
  EXPECT_THAT(end_of(stepper, 0.01, 1),
              testing::AllOf(HasSubstr("particle 0 at"), HasSubstr("it left the domain")));
}

TEST(Detectors, name_particles_that_meet) {
  FlowDomain<2> domain = lattice_taylor_green<2>({.spacing = 0.05}, 1, 0);
  domain.particles.positions[21] += Vector<2>(0.04, 0);
  SemiImplicitOptions options = paper_literal();
  options.speed = 1;
  options.relaxation = 1e-6;
  options.force = true;
  SemiImplicitStepper<2> stepper(domain, {.density = 1, .kinematic_viscosity = 0}, options);
  EXPECT_THAT(end_of(stepper, 1e-3, 1),
              testing::AllOf(HasSubstr("particle 21"), HasSubstr("particles meet")));
}

TEST(Detectors, name_a_solve_that_did_not_converge) {
  SemiImplicitStepper<2> stepper(lattice_taylor_green<2>({.spacing = 0.05, .disorder = 0.1}, 1, 1),
                                 {.density = 1, .kinematic_viscosity = 0}, calm_options(),
                                 {.relative_residual = 1e-13, .maximum_iterations = 1});
  EXPECT_THAT(end_of(stepper, 5e-3, 1),
              testing::AllOf(HasSubstr("step 0"), HasSubstr("the pressure was not solved")));
  EXPECT_EQ(stepper.steps(), 0);
}

TEST(Options, are_refused_with_all_faults_at_once) {
  SemiImplicitOptions options;
  options.operators = OperatorKind::lsmps2;
  options.gradient_ratio = 1;
  options.relaxation = 0;
  try {
    require_admissible(options);
    FAIL() << "not refused";
  } catch (const ParameterError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("lsmps2"), HasSubstr("gradient radius is 1"),
                                             HasSubstr("relaxation of the number density is 0"),
                                             HasSubstr("characteristic speed is 0")));
  }
}

}  // namespace
}  // namespace hemoscale::micro
