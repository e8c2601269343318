#pragma once

#include <string>

#include "micro/ensemble/blocks/block_settings.hpp"

namespace hemoscale::micro::blocks {

/// Largest stable time step of one kind of cells, and what it is made of, in SI. With the stiffness
/// ring + contact + wall = K and the smaller drag of a node, zeta [Pa s]:
///
///   explicit_euler   dt <= 2 zeta / K
///   inertial         dt K/zeta + 4 k U/zeta <= 2 coth(dt zeta / (2 m)), for the momentum drag k
///   and
///                    the largest difference of velocities U = shear rate times radius of a cell;
///                    2 zeta/K without mass, 2 sqrt(m/K) without drag
///   chebyshev        dt <= min[beta(s) zeta / (ring + wall), 2 zeta / contact], beta ~ 0.65 s^2,
///                    because contacts are frozen within a step
///
/// The implicit integrators are stable for membranes, contacts and walls at any step, as far as
/// these behave like springs:
///
///   linearly_implicit    K_c <= 2 D for contacts with the stiffness D on the diagonal: a mode is
///                        multiplied by (1 - q)/(1 + q), q = tau D, at worst; exact for walls
///   constant_operator    M >= 3/4 (I + b tau K), see constant_operator_ring.inl: for segments
///                        compressed to no less than sqrt(3)/2 of their length
///
/// But contacts and walls are springs on one side alone. Nodes that are pushed out of their range
/// by a step that is too long tremble between both. Measured, with a margin:
///
///   implicit integrators dt <= 60 zeta / (-dF/dr of contacts at rest)
///   constant_operator    dt <= 100 zeta / (stiffness of walls); trembles from 280 on
///
/// No integrator sees a contact that begins and ends within a step:
///
///   all                  dt <= (rc - r0) / (shear rate times diameter of a cell)
///
/// and laws of lateral migration are explicit: with the wall lift k, dt <= range^3 / k for the
/// range of walls, the nearest that a centre comes.
struct BlockLimit {
  double drag = 0;       // [Pa s] the smaller of a node
  double ring = 0;       // [Pa] ring_stiffness
  double contact = 0;    // [Pa] contact_stiffness
  double wall = 0;       // [Pa]
  double time_step = 0;  // [s]
  std::string because;   // what the limit is that of, with its numbers
};

/// The strictest limit of all kinds.
BlockLimit block_limit(const BlockSettings& settings);

/// Step by which lateral drift by contacts is right to a few per cent, 3e-4 over the largest shear
/// rate [s]; infinite for a fluid at rest. Trajectories of contacts need a quarter of it, overviews
/// bear the triple.
double default_step(const GivenFlow& flow);

/// Shortest step of nodes with mass in single precision [s], 6e-5 over the largest shear rate:
/// rounding moves a node by up to 2.4e-7 um in a step, half a unit in the last place of its offset,
/// which must stay below a thousandth of its motion relative to the frame, 4 um times shear rate
/// times step. The other explicit integrators remember what rounding drops.
double smallest_single_step(const GivenFlow& flow);

/// What forbids the time step, empty if nothing does: limit, value, remedy.
std::string step_fault(const BlockSettings& settings);

/// What forbids single precision, empty if nothing does.
std::string single_precision_fault(const BlockSettings& settings);

/// @throws ParameterError if the time step exceeds the limit, unless `force`
void require_step(const BlockSettings& settings, bool force);

}  // namespace hemoscale::micro::blocks
