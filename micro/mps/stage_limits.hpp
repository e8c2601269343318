#pragma once

#include <vector>

#include "micro/mps/flow_domain.hpp"
#include "micro/mps/limits.hpp"
#include "micro/mps/stage_options.hpp"

namespace hemoscale::micro {

/// Largest value over all wave vectors k of the Fourier symbol of minus the least-squares Laplacian
/// on a square (cubic) lattice, times the spacing squared,
///
///   sum_j L_j (1 - cos(k . r_j)).
///
/// @param ratio  radius of the fit over the spacing
template <int dim>
double largest_least_squares_eigenvalue(double ratio);

/// What a run is measured by.
struct FlowScales {
  double speed = 0;  // [m/s] characteristic, largest; 0: unknown
  double gap = 0;    // [m] of a channel driven by pressure; 0: there is none
};

/// The limits of the least-squares stepper that depend on the step:
///
///   viscous     explicit viscosity: dt <= 2 l0^2 / (nu Lambda)
///   advective   explicit advection relative to resting nodes, u dt / l0 <= 1; nodes that move must
///               not pass each other, u dt / l0 <= 1/2
///   splitting   chorin: 0.89 12 nu dt / D^2 <= 1 %
template <int dim>
std::vector<Limit> stage_limits(const StageOptions& options, const Fluid& fluid, double spacing,
                                double time_step, const FlowScales& scales);

}  // namespace hemoscale::micro
