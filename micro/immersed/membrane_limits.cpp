#include "micro/immersed/membrane_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hemoscale::micro {

namespace {

constexpr double pi = std::numbers::pi;

// Measured on rings at rest, and held between two sides by tests/stability/immersed.
constexpr double direct_friction = 0.46;
constexpr double area_friction = 1.6;

/// Shares of the limit in a continuum.
double stretch_share(const ImmersedScheme& scheme) {
  const bool is_coupled = scheme.coupling == PressureCoupling::coupled;
  if (scheme.kernel == TransferKernel::four_point) return is_coupled ? 0.75 : 0.55;
  return is_coupled ? 0.5 : 0.3;
}
double bending_share(const ImmersedScheme& scheme) {
  return scheme.kernel == TransferKernel::four_point ? 0.55 : 0.33;
}

struct RateScales {
  double node_spacing = 0;  // [l0]
  int power = 0;            // of k_d: 2 stretch, 4 bending
};

/// Largest rate over all waves in units of modulus / (mu l0^(power - 1)).
double largest_rate(const RateScales& scales, TransferKernel kernel) {
  constexpr int waves = 48;
  constexpr int aliases = 2;
  constexpr int across = 240;
  constexpr double reach = 8;  // [1/l0] of the integral; the transforms are below 1e-2 beyond
  constexpr double dq = reach / across;
  std::vector<double> across_squared(across);
  for (int j = 0; j < across; ++j) {
    const double phi = kernel_transform(kernel, (j + 0.5) * dq);
    across_squared[static_cast<std::size_t>(j)] = phi * phi;
  }
  const bool is_stretch = scales.power == 2;
  double largest = 0;
  for (int i = 1; i <= waves; ++i) {
    const double k = pi / scales.node_spacing * i / waves;
    double mobility = 0;
    for (int m = -aliases; m <= aliases; ++m) {
      const double km = k + 2 * pi * m / scales.node_spacing;
      const double phi = kernel_transform(kernel, km);
      double sum = 0;
      for (int j = 0; j < across; ++j) {
        const double q = (j + 0.5) * dq;
        const double square = km * km + q * q;
        const double share = is_stretch ? q * q : km * km;
        sum += across_squared[static_cast<std::size_t>(j)] * share / (square * square);
      }
      mobility += phi * phi * 2 * sum * dq / (2 * pi);
    }
    const double wave = 2 / scales.node_spacing * std::sin(k * scales.node_spacing / 2);
    largest = std::max(largest, std::pow(wave, scales.power) * mobility);
  }
  return largest;
}

/// @param share  of the limit in a continuum, for steps of Euler
Limit explicit_limit(const char* name, double time_step, double rate, double share,
                     NodeStepping stepping) {
  const double reach = share * (stepping == NodeStepping::forward_euler ? 2 : 1);
  return {.name = name,
          .value = time_step,
          .limit = rate > 0 ? reach / rate : std::numeric_limits<double>::infinity(),
          .unit = "s",
          .remedy = "reduce the time step, soften the membrane, or choose the implicit coupling"};
}

/// @param stiffness  [N/m^2] K
/// @param damping    [1/s] g
Limit direct_limit(const char* name, double time_step, double stiffness, double damping,
                   double mass, ViscousStepping viscosity) {
  const double square = stiffness / mass;  // [1/s^2]
  const double root = std::sqrt(damping * damping + 4 * square);
  // The second form of the root does not cancel.
  const double limit = viscosity == ViscousStepping::implicit_euler ? (damping + root) / square
                                                                    : 4 / (damping + root);
  return {.name = name,
          .value = time_step,
          .limit = square > 0 ? limit : std::numeric_limits<double>::infinity(),
          .unit = "s",
          .remedy = "reduce the time step, soften the membrane, or choose the implicit coupling"};
}

double particle_mass(const Fluid& fluid, double spacing) {
  return fluid.density * spacing * spacing;
}

double wave_damping(const MembraneScales& membrane, const Fluid& fluid, double spacing) {
  return 4 * direct_friction * fluid.kinematic_viscosity / (membrane.node_spacing * spacing);
}

}  // namespace

MembraneScales membrane_scales(const RingMembrane& membrane) {
  const RingMesh& mesh = membrane.mesh();
  const MembraneParameters& p = membrane.parameters();
  MembraneScales scales;
  scales.node_spacing = *std::min_element(mesh.rest_length.begin(), mesh.rest_length.end());
  scales.bending_modulus = p.bending_modulus;
  if (p.stretch_law != StretchLaw::inextensible) scales.stretch_modulus = p.stretch_modulus;
  // One constant for all elements makes the shortest the stiffest.
  if (p.stretch_law == StretchLaw::line_element) {
    scales.stretch_modulus *= mesh.rest_perimeter / mesh.nodes / scales.node_spacing;
  }
  if (p.area_law == AreaLaw::penalty) {
    // |dA/dX_i| is half the chord over a node: about a segment.
    const double squares = mesh.rest_perimeter * mesh.rest_perimeter / mesh.nodes;
    scales.area_stiffness = p.area_modulus * squares / mesh.rest_area;
  }
  return scales;
}

Limit immersed_stretch_limit(double time_step, const MembraneScales& membrane, double viscosity,
                             double spacing, const ImmersedScheme& scheme) {
  const double rate = largest_rate({membrane.node_spacing / spacing, 2}, scheme.kernel) *
                      membrane.stretch_modulus / (viscosity * spacing);
  return explicit_limit("membrane stretch limit", time_step, rate, stretch_share(scheme),
                        scheme.stepping);
}

Limit immersed_bending_limit(double time_step, const MembraneScales& membrane, double viscosity,
                             double spacing, const ImmersedScheme& scheme) {
  const double rate = largest_rate({membrane.node_spacing / spacing, 4}, scheme.kernel) *
                      membrane.bending_modulus / (viscosity * std::pow(spacing, 3));
  return explicit_limit("membrane bending limit", time_step, rate, bending_share(scheme),
                        scheme.stepping);
}

Limit direct_stretch_limit(double time_step, const MembraneScales& membrane, const Fluid& fluid,
                           double spacing, ViscousStepping viscosity) {
  const double stiffness = 4 * membrane.stretch_modulus / membrane.node_spacing;
  return direct_limit("membrane stretch limit", time_step, stiffness,
                      wave_damping(membrane, fluid, spacing), particle_mass(fluid, spacing),
                      viscosity);
}

Limit direct_area_limit(double time_step, const MembraneScales& membrane, const Fluid& fluid,
                        double spacing, ViscousStepping viscosity) {
  const double damping = area_friction * fluid.kinematic_viscosity / (spacing * spacing);
  return direct_limit("membrane area limit", time_step, membrane.area_stiffness, damping,
                      particle_mass(fluid, spacing), viscosity);
}

Limit direct_bending_limit(double time_step, const MembraneScales& membrane, const Fluid& fluid,
                           double spacing, ViscousStepping viscosity) {
  const double stiffness = 16 * membrane.bending_modulus / std::pow(membrane.node_spacing, 3);
  return direct_limit("membrane bending limit", time_step, stiffness,
                      wave_damping(membrane, fluid, spacing), particle_mass(fluid, spacing),
                      viscosity);
}

}  // namespace hemoscale::micro
