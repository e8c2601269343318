#pragma once

#include <array>
#include <vector>

#include "micro/mps/flow_domain.hpp"
#include "micro/mps/least_squares.hpp"
#include "micro/mps/stage_problem.hpp"

namespace hemoscale::micro {

/// Kinetic energy of the fluid, each fluid particle standing for spacing^dim [J/m; 3-D: J].
template <int dim>
double kinetic_energy(const ParticleSet<dim>& particles, double density, double spacing);

/// The flow through the section x = const of a plane channel between the walls y = 0 and `height`.
struct SectionFlow {
  double flow_rate = 0;  // [m^2/s] integral of u
  double pressure = 0;   // [Pa] mean
};

/// By parabolas fitted to the nodes around each of the points of a Gauss rule: exact for the
/// parabola of developed flow.
SectionFlow section_flow(const LeastSquares& fit, const ParticleSet<2>& particles,
                         const PeriodicBox<2>& box, double spacing, double x, double height);

/// Force of the fluid on a boundary,
///
///   F = integral of (p n - mu (L + L^T) n) dS,   n out of the fluid,
///
/// per depth in two dimensions [N/m; 3-D: N]; on closed smooth boundaries the trapezoidal rule of
/// the nodes is as exact as the stresses.
template <int dim>
Vector<dim> boundary_force(const NodeGeometry<dim>& nodes, const ParticleSet<dim>& particles,
                           double viscosity, std::int32_t patch);

/// Mean friction along x of the fluid on two patches between two abscissae [Pa].
double mean_wall_friction(const NodeGeometry<2>& nodes, const ParticleSet<2>& particles,
                          double viscosity, const std::array<std::int32_t, 2>& walls, double from,
                          double to);

}  // namespace hemoscale::micro
