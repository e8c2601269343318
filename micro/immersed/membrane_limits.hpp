#pragma once

#include <vector>

#include "micro/immersed/cell.hpp"
#include "micro/immersed/kernel_function.hpp"
#include "micro/mps/flow_domain.hpp"
#include "micro/mps/limits.hpp"
#include "micro/mps/semi_implicit_options.hpp"
#include "micro/mps/stage_options.hpp"

namespace hemoscale::micro {

/// How membrane nodes are moved with the interpolated velocity.
enum class NodeStepping {
  forward_euler,   // first order
  adams_bashforth  // second order, of two velocities; half the stable step
};

/// What the mobility of a node depends on besides the distances.
struct ImmersedScheme {
  TransferKernel kernel = TransferKernel::four_point;
  PressureCoupling coupling = PressureCoupling::coupled;
  NodeStepping stepping = NodeStepping::forward_euler;
};

/// What the explicit limits of a membrane depend on.
struct MembraneScales {
  double node_spacing = 0;     // [m] s, the shortest segment at rest
  double stretch_modulus = 0;  // [N/m] k_s, of that segment
  double bending_modulus = 0;  // [J] kappa
  double area_stiffness = 0;   // [N/m^2] k_A |dA/dX|^2 / A0 of the penalty; zero for the exact area
};

MembraneScales membrane_scales(const RingMembrane& membrane);

/// Explicit membranes in fluid on resting nodes. On a straight membrane, the node forces of a wave
/// of number k, spread and taken back with the kernel, move it at the rates
///
///   stretch  R(k) = k_s k_d^2 sum_m phi(k_m)^2 int phi(q)^2 q^2   / (mu (k_m^2 + q^2)^2) dq/2pi
///   bending  R(k) = kappa k_d^4 sum_m phi(k_m)^2 int phi(q)^2 k_m^2 / (mu (k_m^2 + q^2)^2) dq/2pi
///
/// with k_d = (2/s) sin(k s / 2), k_m = k + 2 pi m / s and phi the transform of the kernel; with
/// none, k_s k / (4 mu) and kappa k^3 / (4 mu). The step must not exceed
///
///   dt <= b n / max R,   b = 2, with Adams and Bashforth 1.
///
/// n is the share that the flow nodes leave, whose operators resist waves of few spacings less than
/// a continuum does. On rings at rest (s = 0.5..1 l0, two l0, k_s = 1e-4 and 1e-3 N/m) noise starts
/// to grow at a fifth beyond these values:
///
///                  stretch                          bending
///   four_point     0.75 coupled, 0.55 incremental   0.55
///   three_point    0.50 coupled, 0.30 incremental   0.33
///
/// For s = 0.65 l0 the stretch limit is k_s dt = 30, 22, 15 and 9 mu l0. Inertia, left out, only
/// lowers the rates.
Limit immersed_stretch_limit(double time_step, const MembraneScales& membrane, double viscosity,
                             double spacing, const ImmersedScheme& scheme);
Limit immersed_bending_limit(double time_step, const MembraneScales& membrane, double viscosity,
                             double spacing, const ImmersedScheme& scheme);

/// Membrane nodes as particles of mass m = rho l0^2, whose neighbours along the membrane pull with
/// K = 4 k_s / s (bending: 16 kappa / s^3) against the shortest wave; friction with the plasma
/// damps it at the rate g = 4 c nu / (s l0), c = 0.46 (measured on rings, s = 0.5..1 l0):
///
///   implicit viscosity   (K/m) dt^2 <= 4 + 2 g dt
///   explicit viscosity   (K/m) dt^2 <= 4 - 2 g dt
///
/// Without friction dt = 2 sqrt(m / K); with much of it dt = 2 c mu l0 / k_s, or 2 / g: nodes
/// nearer to each other than particles also lower the viscous limit.
///
/// Where fluid can leave, the penalty for the area drives it out and in as a whole: K = k_A
/// |dA/dX|^2 / A0, damped at the rate g = 1.6 nu / l0^2 (measured on one cell in an open channel).
Limit direct_stretch_limit(double time_step, const MembraneScales& membrane, const Fluid& fluid,
                           double spacing, ViscousStepping viscosity);
Limit direct_area_limit(double time_step, const MembraneScales& membrane, const Fluid& fluid,
                        double spacing, ViscousStepping viscosity);
Limit direct_bending_limit(double time_step, const MembraneScales& membrane, const Fluid& fluid,
                           double spacing, ViscousStepping viscosity);

}  // namespace hemoscale::micro
