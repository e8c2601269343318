#pragma once

#include <cmath>

#include "micro/mps/node_domains.hpp"
#include "micro/mps/stage_stepper.hpp"

namespace hemoscale::micro::test {

inline constexpr double pi = 3.14159265358979323846;

/// Channel of unit height in units in which the mean velocity and the viscosity are one: the flow
/// 6 y (1 - y).
inline double parabola(double y) {
  return 6 * y * (1 - y);
}

/// Joined at its ends, driven by the force that keeps the mean velocity at `speed`.
inline FlowDomain<2> forced_channel(double rows, double disorder = 0, double length = 2,
                                    double speed = 1) {
  FlowDomain<2> domain =
      channel_nodes(length, 1, true, {.spacing = 1 / rows, .disorder = disorder, .seed = 11});
  domain.acceleration = [speed](double) { return Vector<2>(12 * speed, 0); };
  return domain;
}

/// With an inlet of the developed profile and an outlet.
inline FlowDomain<2> open_channel(double rows, double disorder = 0, double length = 3) {
  FlowDomain<2> domain =
      channel_nodes(length, 1, false, {.spacing = 1 / rows, .disorder = disorder, .seed = 12});
  domain.patches[inlet_patch].velocity = [](const Vector<2>& x, double) {
    return Vector<2>(parabola(x[1]), 0);
  };
  return domain;
}

template <typename Exact>
double velocity_error(const ParticleSet<2>& particles, const Exact& exact, double scale) {
  double sum = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    sum += (particles.velocities[i] - exact(particles.positions[i])).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(particles.size())) / scale;
}

inline double parabola_error(const ParticleSet<2>& particles) {
  return velocity_error(
      particles, [](const Vector<2>& x) { return Vector<2>(parabola(x[1]), 0); }, 1.5);
}

/// Start of the forced channel from rest (Carslaw and Jaeger 1959), nu = 1.
inline double starting_profile(double y, double t) {
  double u = parabola(y);
  for (int k = 1; k < 200; k += 2) {
    u -= 48 * std::sin(k * pi * y) * std::exp(-k * k * pi * pi * t) / std::pow(k * pi, 3);
  }
  return u;
}

/// Vortices in the unit box, speed one, Re = 100.
inline constexpr double vortex_viscosity = 0.01;
inline Vector<2> vortex(const Vector<2>& x, double t) {
  const double k = 2 * pi;
  const double decay = std::exp(-2 * vortex_viscosity * k * k * t);
  return decay * Vector<2>(std::sin(k * x[0]) * std::cos(k * x[1]),
                           -std::cos(k * x[0]) * std::sin(k * x[1]));
}

/// Error at t = 0.5 over the largest velocity then.
inline double vortex_error(int nodes, double cfl, const StageOptions& options) {
  FlowDomain<2> domain = periodic_nodes<2>({1, 1}, {.spacing = 1.0 / nodes});
  for (std::size_t i = 0; i < domain.particles.size(); ++i) {
    const Vector<2>& x = domain.particles.positions[i];
    domain.particles.velocities[i] = vortex(x, 0);
    domain.particles.pressures[i] = (std::cos(4 * pi * x[0]) + std::cos(4 * pi * x[1])) / 4;
  }
  StageStepper<2> stepper(std::move(domain),
                          {.density = 1, .kinematic_viscosity = vortex_viscosity}, options);
  const double end = 0.5;
  const auto steps = std::lround(std::ceil(end * nodes / cfl));
  for (long k = 0; k < steps; ++k) stepper.step(end / static_cast<double>(steps));
  return velocity_error(
      stepper.particles(), [&](const Vector<2>& x) { return vortex(x, end); },
      std::exp(-8 * vortex_viscosity * pi * pi * end));
}

}  // namespace hemoscale::micro::test
