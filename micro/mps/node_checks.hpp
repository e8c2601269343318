#pragma once

#include "micro/mps/stage_problem.hpp"

namespace hemoscale::micro {

/// @throws ParameterError if the density is not positive, or the viscosity negative (or zero where
///         the flow has no inertia)
void check_fluid(const Fluid& fluid, bool is_quasi_steady);

/// Moved nodes that have come too near each other, or crossed a wall.
/// @param smallest  out: smallest distance of a fluid node to another node [m]
/// @throws NumericalError naming the particle, value and limit
template <int dim>
void check_nodes(const NodeGeometry<dim>& nodes, double& smallest);

/// @returns the largest speed [m/s]
/// @throws NumericalError if a velocity or pressure is not finite, or a particle passes more than
///         five spacings in a step: the explicit advection has lost it
template <int dim>
double check_speeds(const ParticleSet<dim>& particles, double spacing, double time_step);

}  // namespace hemoscale::micro
