#pragma once

#include "micro/mps/lattice_domains.hpp"

namespace hemoscale::micro {

/// Flows of the semi-implicit stepper, on lattices with rows of wall particles. Channels lie
/// between y = 0 and y = gap.

/// Channel of the given length, joined at its ends and driven by a body force per mass.
FlowDomain<2> lattice_periodic_channel(const Lattice& lattice, double length, double gap,
                                       double acceleration);

/// Channel joined at its ends, whose upper wall (patch 1) moves with `speed`.
FlowDomain<2> lattice_couette(const Lattice& lattice, double length, double gap, double speed);

using Inflow = std::function<Vector<2>(const Vector<2>& x, double t)>;

/// Even inflow. Rows half a spacing from the walls carry the flux speed times gap exactly.
Inflow uniform_inflow(double speed);

/// Parabola of the given mean.
Inflow parabolic_inflow(double mean_speed, double gap);

/// Channel with inlet layers (patch 1) before x = 0 and an outlet zone of zero pressure (patch 2)
/// before x = length; all the fluid moves with the inflow at first.
FlowDomain<2> lattice_open_channel(const Lattice& lattice, double length, double gap,
                                   const Inflow& inflow);

/// Box joined at all faces with the vortices
///
///   u = U sin kx cos ky,  v = -U cos kx sin ky   (3-D: both times cos kz, w = 0),  k = 2
///   pi/length.
template <int dim>
FlowDomain<dim> lattice_taylor_green(const Lattice& lattice, double length, double speed);

/// Tank of fluid of the given height at rest under gravity along -y, open above: a free surface.
FlowDomain<2> lattice_tank(const Lattice& lattice, double width, double height, double gravity);

/// Square of fluid around the origin without walls, turning like a rigid body at first.
FlowDomain<2> lattice_rotating_square(const Lattice& lattice, double side, double rate);

}  // namespace hemoscale::micro
