#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "micro/mps/lattice_domains_flows.hpp"
#include "micro/mps/node_domains.hpp"
#include "micro/mps/semi_implicit_stepper.hpp"
#include "micro/mps/stage_stepper.hpp"
#include "tests/support/mps/flows.hpp"

namespace hemoscale::micro {
namespace {

using namespace test;

constexpr Fluid fluid{.density = 3, .kinematic_viscosity = 0.7};
constexpr double k = 2 * pi;

/// Kolmogorov flow in the unit box: the force per mass sin(ky) g(t) along x.
template <typename History>
void drive(FlowDomain<2>& domain, const History& history) {
  domain.local_acceleration = [history](const ParticleSet<2>& particles, double t,
                                        std::vector<Vector<2>>& acceleration) {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      acceleration[i][0] += std::sin(k * particles.positions[i][1]) * history(t);
    }
  };
}

FlowDomain<2> steadily_driven(double nodes) {
  FlowDomain<2> domain = periodic_nodes<2>({1, 1}, {.spacing = 1 / nodes});
  drive(domain, [](double) { return 1; });
  return domain;
}

double kolmogorov_error(const ParticleSet<2>& particles, double amplitude) {
  return velocity_error(
      particles, [&](const Vector<2>& x) { return Vector<2>(amplitude * std::sin(k * x[1]), 0); },
      amplitude);
}

constexpr double steady = 1 / (0.7 * k * k);  // [m/s] amplitude

TEST(LocalAcceleration, drives_quasi_steady_flow_with_second_order) {
  std::vector<double> errors;
  for (const double nodes : {10.0, 20.0}) {
    StageOptions options;
    options.inertia = Inertia::quasi_steady;
    StageStepper<2> stepper(steadily_driven(nodes), fluid, options);
    stepper.step(1);
    errors.push_back(kolmogorov_error(stepper.particles(), steady));
  }
  EXPECT_LT(errors[1], 0.2);  // mostly that of the Laplacian, 1.6 (k l0)^2
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8);
}

TEST(LocalAcceleration, settles_without_passing_time) {
  StageOptions options;
  options.inertia = Inertia::quasi_steady;
  StageStepper<2> stepped(steadily_driven(10), fluid, options);
  StageStepper<2> settled(steadily_driven(10), fluid, options);
  stepped.step(1);
  settled.settle();
  EXPECT_EQ(settled.time(), 0);
  EXPECT_EQ(settled.steps(), 0);
  EXPECT_EQ(settled.particles().velocities, stepped.particles().velocities);
}

TEST(LocalAcceleration, of_each_stage_keeps_the_order_in_time) {
  // Its history is such that u = sin(ky) sin(wt) solves the problem in a continuum.
  constexpr double w = 30;
  for (const PressureCoupling coupling :
       {PressureCoupling::coupled, PressureCoupling::incremental}) {
    const auto amplitude = [&](int steps) {
      FlowDomain<2> domain = periodic_nodes<2>({1, 1}, {.spacing = 0.1});
      drive(domain, [](double t) { return w * std::cos(w * t) + 0.7 * k * k * std::sin(w * t); });
      StageOptions options;
      options.coupling = coupling;
      StageStepper<2> stepper(std::move(domain), fluid, options);
      for (int n = 0; n < steps; ++n) stepper.step(0.05 / steps);
      double largest = 0;
      for (const Vector<2>& u : stepper.particles().velocities) largest = std::max(largest, u[0]);
      return largest;
    };
    const double exact = amplitude(320);
    const double coarse = std::abs(amplitude(10) - exact);
    const double fine = std::abs(amplitude(20) - exact);
    EXPECT_GT(std::log2(coarse / fine), 1.8);
    EXPECT_NEAR(exact, std::sin(w * 0.05) * std::sin(pi / 2 * 0.8), 0.15);
  }
}

TEST(LocalAcceleration, acts_on_the_walls_as_a_body_force_does) {
  for (const Inertia inertia : {Inertia::unsteady, Inertia::quasi_steady}) {
    StageOptions options;
    options.inertia = inertia;
    FlowDomain<2> everywhere = forced_channel(8);
    FlowDomain<2> each = everywhere;
    each.acceleration = nullptr;
    each.local_acceleration = [](const ParticleSet<2>&, double,
                                 std::vector<Vector<2>>& acceleration) {
      for (Vector<2>& a : acceleration) a += Vector<2>(12, 3);
    };
    everywhere.acceleration = [](double) { return Vector<2>(12, 3); };
    StageStepper<2> one(std::move(everywhere), fluid, options);
    StageStepper<2> other(std::move(each), fluid, options);
    for (int n = 0; n < 3; ++n) {
      one.step(0.1);
      other.step(0.1);
    }
    EXPECT_EQ(one.particles().velocities, other.particles().velocities);
    EXPECT_EQ(one.particles().pressures, other.particles().pressures);
  }
}

TEST(LocalAcceleration, is_asked_where_the_nodes_of_the_stage_are) {
  FlowDomain<2> domain = forced_channel(8);
  for (Vector<2>& u : domain.particles.velocities) u[0] = 0.3;
  std::vector<std::pair<double, double>> seen;  // time, place of a node
  const auto node = static_cast<std::size_t>(
      std::find(domain.particles.kinds.begin(), domain.particles.kinds.end(), ParticleKind::fluid) -
      domain.particles.kinds.begin());
  domain.local_acceleration = [&](const ParticleSet<2>& particles, double t,
                                  std::vector<Vector<2>>&) {
    seen.emplace_back(t, particles.positions[node][0]);
  };
  const double start = domain.particles.positions[node][0];
  StageOptions options;
  options.motion = NodeMotion::lagrangian;
  StageStepper<2> stepper(std::move(domain), fluid, options);
  stepper.step(0.01);
  ASSERT_EQ(seen.size(), 2U);
  const double g = 1 - 1 / std::sqrt(2.0);
  EXPECT_NEAR(seen[0].first, g * 0.01, 1e-15);
  EXPECT_NEAR(seen[0].second, start + g * 0.01 * 0.3, 1e-12);
  EXPECT_NEAR(seen[1].first, 0.01, 1e-15);
  EXPECT_GT(seen[1].second, seen[0].second);
}

SemiImplicitOptions repaired(ViscousStepping viscosity, ParticleCoupling coupling) {
  SemiImplicitOptions options = best_repaired();
  options.viscosity = viscosity;
  options.coupling = coupling;
  options.speed = steady;
  return options;
}

TEST(LocalAcceleration, drives_moving_particles) {
  for (const ViscousStepping viscosity :
       {ViscousStepping::explicit_euler, ViscousStepping::implicit_euler}) {
    for (const ParticleCoupling coupling :
         {ParticleCoupling::chorin, ParticleCoupling::incremental}) {
      FlowDomain<2> domain = lattice_taylor_green<2>({.spacing = 0.05}, 1, 0);
      drive(domain, [](double) { return 1; });
      SemiImplicitStepper<2> stepper(domain, fluid, repaired(viscosity, coupling));
      stepper.step(1e-3);
      // From rest, in a flow free of divergence, the first step is that of the force alone.
      const double damping =
          viscosity == ViscousStepping::implicit_euler ? 1 / (1 + 1e-3 * 0.7 * k * k) : 1;
      EXPECT_LT(kolmogorov_error(stepper.particles(), 1e-3 * damping), 2e-3);
      for (int n = 1; n < 100; ++n) stepper.step(1e-3);
      const double amplitude = steady * (1 - std::exp(-0.7 * k * k * 0.1));
      EXPECT_LT(kolmogorov_error(stepper.particles(), amplitude), 0.05);
    }
  }
}

TEST(LocalAcceleration, of_moving_particles_is_that_of_a_body_force_to_the_bit) {
  const auto run = [](bool is_local) {
    FlowDomain<2> domain = lattice_periodic_channel({.spacing = 0.1}, 1, 1, 0);
    domain.acceleration = nullptr;
    if (is_local) {
      domain.local_acceleration = [](const ParticleSet<2>&, double,
                                     std::vector<Vector<2>>& acceleration) {
        for (Vector<2>& a : acceleration) a += Vector<2>(1, 0);
      };
    } else {
      domain.acceleration = [](double) { return Vector<2>(1, 0); };
    }
    SemiImplicitStepper<2> stepper(
        domain, fluid, repaired(ViscousStepping::implicit_euler, ParticleCoupling::chorin));
    for (int n = 0; n < 10; ++n) stepper.step(0.02);
    return stepper.snapshot().reals;
  };
  EXPECT_EQ(run(true), run(false));
}

}  // namespace
}  // namespace hemoscale::micro
