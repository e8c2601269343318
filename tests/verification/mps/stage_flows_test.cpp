#include <gtest/gtest.h>

#include "micro/mps/flow_figures.hpp"
#include "tests/support/mps/flows.hpp"

namespace hemoscale::micro {
namespace {

using namespace test;

constexpr Fluid fluid{.density = 1, .kinematic_viscosity = 1};

TEST(StageFlows, poiseuille_is_exact_on_disordered_nodes_whatever_the_step) {
  for (const PressureCoupling coupling :
       {PressureCoupling::coupled, PressureCoupling::incremental}) {
    StageOptions options;
    options.coupling = coupling;
    // nu dt / l0^2 = 1e4: nothing limits it but the advection, slow here.
    const double speed = 1e-4;
    StageStepper<2> stepper(forced_channel(10, 0.2, 2, speed), fluid, options);
    for (int k = 0; k < 24; ++k) stepper.step(100);
    const double error = velocity_error(
        stepper.particles(),
        [&](const Vector<2>& x) { return Vector<2>(speed * parabola(x[1]), 0); }, 1.5 * speed);
    // The projection nears the steady state step by step.
    EXPECT_LT(error, coupling == PressureCoupling::coupled ? 1e-10 : 1e-8);
    EXPECT_GT(error, 0);
  }
}

TEST(StageFlows, poiseuille_is_exact_on_moving_nodes) {
  for (const NodeMotion motion : {NodeMotion::lagrangian, NodeMotion::ale}) {
    StageOptions options;
    options.motion = motion;
    options.shifting = Shifting::concentration;
    options.shifting_strength = 0.3;
    // Re = 0.1, CFL 0.2 of the mean velocity, 10 % disorder; four viscous times.
    StageStepper<2> stepper(forced_channel(10, 0.1, 2, 0.1), fluid, options);
    for (int k = 0; k < 20; ++k) stepper.step(0.2);
    const double error = velocity_error(
        stepper.particles(), [](const Vector<2>& x) { return Vector<2>(0.1 * parabola(x[1]), 0); },
        0.15);
    // The shift of ale is part of the motion, of second order in the step.
    EXPECT_LT(error, motion == NodeMotion::lagrangian ? 1e-10 : 1e-7);
    EXPECT_GT(stepper.report().smallest_distance, 0.06);
  }
}

TEST(StageFlows, moving_nodes_enter_and_leave_without_a_trace) {
  StageOptions options;
  options.motion = NodeMotion::lagrangian;
  options.shifting = Shifting::concentration;
  options.shifting_strength = 0.3;
  StageStepper<2> stepper(open_channel(8, 0.1), fluid, options);
  for (int k = 0; k < 120; ++k) stepper.step(0.0125);
  EXPECT_LT(parabola_error(stepper.particles()), 1e-6);  // start-up, exp(-pi^2 1.5)
  EXPECT_GT(stepper.report().inserted, 50U);
  EXPECT_GT(stepper.report().removed, 50U);
  const double start = static_cast<double>(open_channel(8).particles.size());
  EXPECT_NEAR(static_cast<double>(stepper.particles().size()), start, 0.1 * start);
}

double start_up_error(int rows, int steps, PressureCoupling coupling, TimeScheme scheme) {
  StageOptions options;
  options.coupling = coupling;
  options.time_scheme = scheme;
  StageStepper<2> stepper(forced_channel(rows, 0, std::max(1.0, 8.0 / rows)), fluid, options);
  for (int k = 0; k < steps; ++k) stepper.step(0.1 / steps);
  return velocity_error(
      stepper.particles(),
      [](const Vector<2>& x) { return Vector<2>(starting_profile(x[1], 0.1), 0); },
      starting_profile(0.5, 0.1));
}

TEST(StageFlows, start_up_converges_in_space_with_order_above_one_point_seven) {
  const double coarse = start_up_error(10, 40, PressureCoupling::coupled, TimeScheme::sdirk2);
  const double fine = start_up_error(20, 40, PressureCoupling::coupled, TimeScheme::sdirk2);
  EXPECT_GT(std::log2(coarse / fine), 1.7);
  EXPECT_LT(fine, 3e-3);
}

TEST(StageFlows, start_up_needs_two_steps_for_four_per_mille) {
  EXPECT_LT(start_up_error(20, 2, PressureCoupling::coupled, TimeScheme::sdirk2), 4e-3);
}

/// Distance of the velocities from those with a fine step, on the same nodes.
double step_error(int steps, const StageOptions& options) {
  const auto run = [&](int count) {
    StageStepper<2> stepper(forced_channel(8, 0, 1), fluid, options);
    for (int k = 0; k < count; ++k) stepper.step(0.1 / count);
    return stepper.particles();
  };
  const ParticleSet<2> reference = run(16 * steps);
  const ParticleSet<2> found = run(steps);
  double sum = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    sum += (found.velocities[i] - reference.velocities[i]).squaredNorm();
  }
  return std::sqrt(sum);
}

TEST(StageFlows, time_schemes_have_their_orders) {
  StageOptions options;
  EXPECT_NEAR(std::log2(step_error(8, options) / step_error(16, options)), 2, 0.25);
  options.time_scheme = TimeScheme::euler;
  EXPECT_NEAR(std::log2(step_error(8, options) / step_error(16, options)), 1, 0.15);
}

TEST(StageFlows, vortices_decay_with_second_order_on_resting_nodes) {
  for (const PressureCoupling coupling :
       {PressureCoupling::coupled, PressureCoupling::incremental}) {
    StageOptions options;
    options.coupling = coupling;
    const double coarse = vortex_error(16, 0.2, options);
    const double fine = vortex_error(32, 0.2, options);
    EXPECT_LT(fine, 5e-3);
    EXPECT_GT(std::log2(coarse / fine), 1.8);
  }
}

TEST(StageFlows, vortices_decay_on_moving_nodes) {
  StageOptions options;
  options.coupling = PressureCoupling::incremental;
  options.motion = NodeMotion::lagrangian;
  options.shifting = Shifting::concentration;
  options.shifting_strength = 0.3;
  EXPECT_LT(vortex_error(25, 0.3, options), 1e-2);
  EXPECT_LT(vortex_error(32, 0.2, options), 1e-2);
}

/// Error a height behind the inlet, where the projection leaves a boundary layer of the pressure.
double developed_error(const ParticleSet<2>& particles) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vector<2>& x = particles.positions[i];
    if (x[0] < 1 || x[0] > 2) continue;
    sum += (particles.velocities[i] - Vector<2>(parabola(x[1]), 0)).squaredNorm();
    count += 1;
  }
  return std::sqrt(sum / count) / 1.5;
}

TEST(StageFlows, five_thousand_steps_do_not_drift) {
  for (const bool is_coupled : {true, false}) {
    StageOptions options;
    options.coupling = is_coupled ? PressureCoupling::coupled : PressureCoupling::incremental;
    StageStepper<2> stepper(open_channel(10), fluid, options);
    for (int k = 0; k < 500; ++k) stepper.step(0.02);
    const double early = developed_error(stepper.particles());
    for (int k = 0; k < 4500; ++k) stepper.step(0.02);
    const double late = developed_error(stepper.particles());
    EXPECT_LT(late, is_coupled ? 1e-6 : 3e-3);
    EXPECT_LT(std::abs(late - early), is_coupled ? 1e-9 : 1e-6);
  }
}

TEST(StageFlows, chorin_leaves_a_slip_linear_in_the_step) {
  // The slip 12 nu dt / D^2 of the mean velocity, with the flux held by the inlet: the profile is
  // s + (1 - s) 6 y (1 - y), off by s times sqrt(1/5) in root mean square.
  for (const double dt : {0.002, 0.004}) {
    StageOptions options;
    options.coupling = PressureCoupling::chorin;
    options.time_scheme = TimeScheme::euler;
    StageStepper<2> stepper(open_channel(16), fluid, options);
    for (int k = 0; k < 400; ++k) stepper.step(dt);
    EXPECT_NEAR(1.5 * developed_error(stepper.particles()) / (std::sqrt(0.2) * 12 * dt), 1, 0.2)
        << dt;
  }
}

TEST(StageFlows, quasi_steady_inlet_flow_develops_and_keeps_its_flux) {
  StageOptions options;
  options.inertia = Inertia::quasi_steady;
  FlowDomain<2> domain = channel_nodes(4, 1, false, {.spacing = 1.0 / 20});
  domain.patches[inlet_patch].velocity = [](const Vector<2>&, double) { return Vector<2>(1, 0); };
  StageStepper<2> stepper(std::move(domain), fluid, options);
  stepper.step(1);
  const auto flow = [&](double x) {
    return section_flow({.radius = 0.125}, stepper.particles(), stepper.domain().box, 0.05, x, 1);
  };
  EXPECT_NEAR(flow(3).flow_rate / flow(1.5).flow_rate, 1, 1e-5);
  EXPECT_NEAR((flow(1.5).pressure - flow(3).pressure) / (12 * 1.5 * flow(3).flow_rate), 1, 1e-3);
}

TEST(StageFlows, coupled_iteration_and_factorisation_agree) {
  for (const bool is_open : {true, false}) {
    std::vector<ParticleSet<2>> found;
    for (const LinearSolverKind kind : {LinearSolverKind::banded, LinearSolverKind::aggregate}) {
      StageOptions options;
      options.linear_solver = kind;
      options.tolerance.relative_residual = 1e-11;
      StageStepper<2> stepper(is_open ? open_channel(8, 0.1) : forced_channel(8, 0.1), fluid,
                              options);
      for (int k = 0; k < 3; ++k) stepper.step(0.01);
      found.push_back(stepper.particles());
    }
    for (std::size_t i = 0; i < found[0].size(); ++i) {
      ASSERT_NEAR((found[0].velocities[i] - found[1].velocities[i]).norm(), 0, 1e-7) << i;
      ASSERT_NEAR(found[0].pressures[i], found[1].pressures[i], 1e-5) << i;
    }
  }
}

TEST(StageFlows, pipe_flow_is_exact) {
  StageOptions options;
  options.inertia = Inertia::quasi_steady;
  FlowDomain<3> domain = pipe_nodes(0.6, 0.5, true, {.spacing = 0.1, .disorder = 0.1, .seed = 2});
  domain.acceleration = [](double) { return Vector<3>(16, 0, 0); };  // u = 4 (1/4 - r^2)
  StageStepper<3> stepper(std::move(domain), fluid, options);
  stepper.step(1);
  const ParticleSet<3>& particles = stepper.particles();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vector<3>& x = particles.positions[i];
    const double u = 4 * (0.25 - x[1] * x[1] - x[2] * x[2]);
    ASSERT_NEAR((particles.velocities[i] - Vector<3>(u, 0, 0)).norm(), 0, 1e-10) << i;
  }
}

TEST(StageFlows, cylinder_between_plates_feels_the_drag_of_faxen) {
  // lambda = 27.895 per viscosity and largest velocity at a diameter of 0.3 of the gap: boundary
  // integrals, and the series of Ben Richou et al. 2004.
  StageOptions options;
  options.inertia = Inertia::quasi_steady;
  const auto drag = [&](double rows) {
    FlowDomain<2> domain = cylinder_nodes(3, 1, 0.15, 1.5, false, {.spacing = 1 / rows});
    domain.patches[inlet_patch].velocity = [](const Vector<2>& x, double) {
      return Vector<2>(parabola(x[1]), 0);
    };
    StageStepper<2> stepper(std::move(domain), fluid, options);
    stepper.step(1);
    return boundary_force(stepper.nodes(), stepper.particles(), 1, 4)[0] / 1.5;
  };
  EXPECT_NEAR(drag(40) / 27.895125, 1, 0.02);
}

}  // namespace
}  // namespace hemoscale::micro
