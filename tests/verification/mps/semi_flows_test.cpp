#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "micro/error.hpp"
#include "micro/mps/lattice_domains_flows.hpp"
#include "micro/mps/semi_implicit_stepper.hpp"

namespace hemoscale::micro {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

constexpr Fluid water = {.density = 1000, .kinematic_viscosity = 1e-6};
constexpr double gap = 10e-6;   // [m]
constexpr double speed = 0.01;  // [m/s]

/// Root mean square of the velocity error of the fluid, over `scale`.
double velocity_error(const SemiImplicitStepper<2>& stepper, double scale,
                      const std::function<Vector<2>(const Vector<2>&)>& exact) {
  const ParticleSet<2>& particles = stepper.particles();
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.kinds[i] != ParticleKind::fluid) continue;
    sum += (particles.velocities[i] - exact(particles.positions[i])).squaredNorm();
    ++count;
  }
  return std::sqrt(sum / count) / scale;
}

void run(SemiImplicitStepper<2>& stepper, double dt, double duration) {
  const auto steps = static_cast<int>(std::lround(duration / dt));
  for (int n = 0; n < steps; ++n) stepper.step(dt);
}

/// Start-up of the plane channel flow from rest, over its final maximum.
double start_up_poiseuille(double y, double t) {
  const double h = gap / 2;
  const double s = (y - h) / h;
  double u = 1 - s * s;
  for (int n = 0; n < 60; ++n) {
    const double a = 2 * n + 1;
    u -= 32 / (pi * pi * pi) * (n % 2 == 0 ? 1 : -1) / (a * a * a) * std::cos(a * pi * s / 2) *
         std::exp(-a * a * pi * pi * water.kinematic_viscosity * t / (4 * h * h));
  }
  return u;
}

double start_up_couette(double y, double t) {
  double u = y / gap;
  for (int n = 1; n < 120; ++n) {
    u += 2 / pi * (n % 2 == 0 ? 1 : -1) / n * std::sin(n * pi * y / gap) *
         std::exp(-n * n * pi * pi * water.kinematic_viscosity * t / (gap * gap));
  }
  return u;
}

/// Error at t = 0.1 D^2 / nu with `rows` across.
double poiseuille_error(int rows, SemiImplicitOptions options, double viscous_number) {
  const double l0 = gap / rows;
  const double maximum = 1.5 * speed;
  const double force = 8 * water.kinematic_viscosity * maximum / (gap * gap);
  options.speed = speed;
  SemiImplicitStepper<2> stepper(lattice_periodic_channel({.spacing = l0}, 10 * l0, gap, force),
                                 water, options, {.relative_residual = 1e-8});
  run(stepper, viscous_number * l0 * l0 / water.kinematic_viscosity, 1e-5);
  return velocity_error(stepper, maximum, [&](const Vector<2>& x) {
    return Vector<2>(maximum * start_up_poiseuille(x.y(), stepper.time()), 0);
  });
}

TEST(SemiImplicitPoiseuille, of_the_paper_is_first_order_for_its_walls_slip) {
  SemiImplicitOptions options = paper_literal();
  options.relaxation = 0.2;
  const double coarse = poiseuille_error(10, options, 0.2);
  const double fine = poiseuille_error(20, options, 0.2);
  EXPECT_NEAR(coarse, 0.1025, 0.002);
  EXPECT_NEAR(fine, 0.0536, 0.002);
  EXPECT_NEAR(std::log2(coarse / fine), 0.93, 0.05);
}

TEST(SemiImplicitPoiseuille, with_mirrored_walls_is_second_order) {
  const double coarse = poiseuille_error(10, best_repaired(), 0.5);
  const double fine = poiseuille_error(20, best_repaired(), 0.5);
  EXPECT_LT(coarse, 0.02);
  EXPECT_LT(fine, 0.005);
  EXPECT_GT(std::log2(coarse / fine), 1.7);
}

TEST(SemiImplicitCouette, follows_the_moving_wall) {
  SemiImplicitOptions options = best_repaired();
  options.speed = speed;
  const double l0 = gap / 20;
  SemiImplicitStepper<2> stepper(lattice_couette({.spacing = l0}, 10 * l0, gap, speed), water,
                                 options, {.relative_residual = 1e-8});
  run(stepper, 0.5 * l0 * l0 / water.kinematic_viscosity, 1e-5);
  EXPECT_LT(velocity_error(stepper, speed,
                           [&](const Vector<2>& x) {
                             return Vector<2>(speed * start_up_couette(x.y(), stepper.time()), 0);
                           }),
            4e-3);
}

SemiImplicitStepper<2> taylor_green(int n, double disorder, SemiImplicitOptions options) {
  options.speed = 1;
  return SemiImplicitStepper<2>(
      lattice_taylor_green<2>({.spacing = 1.0 / n, .disorder = disorder}, 1, 1),
      {.density = 1, .kinematic_viscosity = 0.01}, options, {.relative_residual = 1e-8});
}

double taylor_green_error(const SemiImplicitStepper<2>& stepper) {
  const double k = 2 * pi;
  const double decay = std::exp(-2 * k * k * 0.01 * stepper.time());
  return velocity_error(stepper, decay, [&](const Vector<2>& x) {
    return Vector<2>(decay * std::sin(k * x[0]) * std::cos(k * x[1]),
                     -decay * std::cos(k * x[0]) * std::sin(k * x[1]));
  });
}

TEST(SemiImplicitTaylorGreen, is_solved_on_moving_particles_by_the_repairs) {
  SemiImplicitStepper<2> stepper = taylor_green(32, 0.1, best_repaired());
  run(stepper, 0.1 / 32, 0.5);
  EXPECT_LT(taylor_green_error(stepper), 1e-2);
  EXPECT_LT(stepper.report().density_error, 0.03);
  EXPECT_GT(stepper.report().nearest, 0.5);
}

// Documented failures: the scheme as printed opens voids whatever the relaxation.
class LiteralTaylorGreen : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(, LiteralTaylorGreen, testing::Values(1.0, 0.5),
                         [](const auto& each) { return each.param == 1 ? "full" : "half"; });

TEST_P(LiteralTaylorGreen, ends_in_an_error_before_half_a_time_unit) {
  SemiImplicitOptions options = paper_literal();
  options.relaxation = GetParam();
  options.force = true;
  SemiImplicitStepper<2> stepper = taylor_green(25, 0, options);
  EXPECT_THROW(run(stepper, 0.1 / 25, 0.5), NumericalError);
  EXPECT_LT(stepper.time(), 0.25);
}

TEST(SemiImplicitTank, comes_to_rest_under_the_hydrostatic_pressure) {
  const double height = 0.2;
  const double gravity = 9.81;
  const double fall = std::sqrt(gravity * height);
  SemiImplicitOptions options = paper_literal();
  options.gradient_form = GradientForm::minimum;
  options.relaxation = 0.02;
  options.free_surface_ratio = 0.97;
  options.speed = fall;
  const double l0 = height / 20;
  SemiImplicitStepper<2> stepper(lattice_tank({.spacing = l0}, height, height, gravity),
                                 {.density = 1000, .kinematic_viscosity = 0.01}, options,
                                 {.relative_residual = 1e-8});
  run(stepper, 0.05 * l0 / fall, 1);
  EXPECT_EQ(stepper.report().surface_particles, 20u);
  EXPECT_LT(stepper.report().fastest, 5e-3 * fall);  // surface particles keep trembling
  const ParticleSet<2>& particles = stepper.particles();
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.kinds[i] != ParticleKind::fluid) continue;
    const double exact = 1000 * gravity * (height - particles.positions[i].y());
    sum += std::pow(particles.pressures[i] - exact, 2);
    ++count;
  }
  EXPECT_LT(std::sqrt(sum / count), 0.01 * 1000 * gravity * height);
}

TEST(SemiImplicitSquare, has_the_pressure_of_a_turning_body_at_first) {
  SemiImplicitOptions options = best_repaired();
  options.free_surface_ratio = 0.97;
  options.speed = 1;
  const int n = 64;
  SemiImplicitStepper<2> stepper(lattice_rotating_square({.spacing = 1.0 / n}, 1, 1),
                                 {.density = 1000, .kinematic_viscosity = 0}, options,
                                 {.relative_residual = 1e-8});
  stepper.step(0.1 / n);
  double middle = 0;
  double nearest = 1;
  for (std::size_t i = 0; i < stepper.particles().size(); ++i) {
    const double distance = stepper.particles().positions[i].norm();
    if (distance >= nearest) continue;
    nearest = distance;
    middle = stepper.particles().pressures[i];
  }
  // The surface rows, where the pressure is zero, lie within: the square is smaller by two of them.
  const double side = 1 - 4.0 / n;
  EXPECT_NEAR(middle / (1000 * side * side), -0.147343, 0.05 * 0.147343);
}

TEST(SemiImplicitOpenChannel, keeps_the_balance_of_particles_and_the_flux) {
  SemiImplicitOptions options = best_repaired();
  options.speed = speed;
  options.gap = gap;
  const double l0 = gap / 10;
  SemiImplicitStepper<2> stepper(
      lattice_open_channel({.spacing = l0}, 4 * gap, gap, uniform_inflow(speed)),
      {.density = 1000, .kinematic_viscosity = 1e-7}, options, {.relative_residual = 1e-8});
  run(stepper, 9e-7, 9e-4);
  const ParticleLedger& ledger = stepper.ledger();
  EXPECT_EQ(count_moving(stepper.particles()), ledger.initial + ledger.entered - ledger.left);
  // Nine spacings have passed the inlet in each of ten rows.
  EXPECT_EQ(ledger.entered, 90);
  EXPECT_NEAR(static_cast<double>(ledger.left), 90, 8);
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < stepper.particles().size(); ++i) {
    const Vector<2>& x = stepper.particles().positions[i];
    if (stepper.particles().kinds[i] != ParticleKind::fluid) continue;
    if (x.x() < 1.5 * gap || x.x() > 2.5 * gap) continue;
    const double s = x.y() / gap;
    sum += std::pow(stepper.particles().velocities[i].x() - 6 * speed * s * (1 - s), 2);
    ++count;
  }
  EXPECT_LT(std::sqrt(sum / count), 0.06 * 1.5 * speed);
}

TEST(SemiImplicitOpenChannel, at_a_higher_outlet_pressure_moves_alike) {
  SemiImplicitOptions options = best_repaired();
  options.speed = speed;
  const double l0 = gap / 10;
  std::vector<SemiImplicitStepper<2>> steppers;
  for (const double outlet : {0.0, 500.0}) {
    FlowDomain<2> domain =
        lattice_open_channel({.spacing = l0}, 3 * gap, gap, uniform_inflow(speed));
    domain.patches[2].pressure = [outlet](double) { return outlet; };
    steppers.emplace_back(domain, water, options, SolveTolerance{.relative_residual = 1e-12});
    for (int n = 0; n < 20; ++n) steppers.back().step(2e-7);
  }
  const ParticleSet<2>& low = steppers[0].particles();
  const ParticleSet<2>& high = steppers[1].particles();
  ASSERT_EQ(low.identities, high.identities);
  for (std::size_t i = 0; i < low.size(); ++i) {
    ASSERT_LT((low.velocities[i] - high.velocities[i]).norm(), 1e-6 * speed) << i;
    if (low.kinds[i] != ParticleKind::fluid) continue;
    ASSERT_NEAR(high.pressures[i] - low.pressures[i], 500, 0.05) << i;
  }
}

TEST(SemiImplicitTaylorGreen, in_three_dimensions_decays_at_the_viscous_rate) {
  SemiImplicitOptions options = best_repaired();
  options.gradient_ratio = 2.1;
  options.laplacian_ratio = 2.1;
  options.speed = 0.01;
  const int n = 16;
  const double viscosity = 0.1;
  SemiImplicitStepper<3> stepper(lattice_taylor_green<3>({.spacing = 1.0 / n}, 1, 0.01),
                                 {.density = 1, .kinematic_viscosity = viscosity}, options);
  const double dt = 0.05 / (n * n * viscosity);
  stepper.step(dt);
  const double first = stepper.report().kinetic_energy;
  const int steps = 20;
  for (int k = 0; k < steps; ++k) stepper.step(dt);
  const double rate = -std::log(stepper.report().kinetic_energy / first) / (steps * dt);
  // Three squared wave numbers, twice for the energy; the lattice at 16 points is a few per cent
  // slow.
  EXPECT_NEAR(rate / (6 * 4 * pi * pi * viscosity), 0.97, 0.03);
}

}  // namespace
}  // namespace hemoscale::micro
