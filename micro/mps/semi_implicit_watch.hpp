#pragma once

#include <string>
#include <vector>

#include "micro/mps/limits.hpp"
#include "micro/mps/semi_implicit_parts.hpp"

namespace hemoscale::micro {

/// Thresholds of the detectors.
struct SemiImplicitThresholds {
  static constexpr double nearest = 0.3;        // [l0] two particles must not come nearer
  static constexpr double void_density = 0.5;   // [n0] fluid must not become thinner
  static constexpr double runaway_speed = 20;   // [-] times the characteristic speed
  static constexpr double kinetic_energy = 10;  // [-] times that of fluid all at that speed
};

/// Fills the report of the step and looks for the signs of failure: values that are not finite,
/// particles that left the domain, that met or lost each other, growth of the kinetic energy.
/// @param limits  of the step; the message names those that are exceeded
/// @throws NumericalError naming step, time, particle, value, limit and remedy
template <int dim>
void watch(const SemiImplicitSetting<dim>& setting, const SemiImplicitState<dim>& state,
           SemiImplicitWork<dim>& work, const std::vector<Limit>& limits);

/// What to do: lower the step below a limit that it exceeds, or else a general advice.
std::string diagnosis(const std::vector<Limit>& limits);

/// Limits of a run with the given step. The deviation of the number density is that of the initial
/// packing; see density_kick_limit().
template <int dim>
std::vector<Limit> semi_implicit_limits(const SemiImplicitOptions& options, const Fluid& fluid,
                                        double spacing, double time_step, double deviation);

/// Root mean square of n / n0 - 1 of the fluid.
template <int dim>
double density_deviation(const SemiImplicitSetting<dim>& setting,
                         const SemiImplicitState<dim>& state, const std::vector<double>& density);

}  // namespace hemoscale::micro
