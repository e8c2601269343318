#pragma once

#include <cstdint>
#include <vector>

#include "micro/mps/flow_domain.hpp"

namespace hemoscale::micro {

/// How the nodes of a domain are laid out.
struct NodeSpacing {
  double spacing = 0;      // [m] l0, positive
  double disorder = 0;     // [-] each inner node is moved by up to this times l0 along each axis
  std::uint64_t seed = 0;  // of the disorder
};

/// Patches of the channels, in this order.
enum ChannelPatch : std::int32_t {
  lower_wall = 0,
  upper_wall = 1,
  inlet_patch = 2,
  outlet_patch = 3
};

/// Plane channel 0 <= x <= length, 0 <= y <= height, with nodes on its walls.
/// @param is_periodic  along x; otherwise nodes at x = 0 are inlet, at x = length outlet nodes
/// @throws ParameterError for lengths that hold fewer than four spacings, or a disorder outside
///         [0, 0.5)
FlowDomain<2> channel_nodes(double length, double height, bool is_periodic,
                            const NodeSpacing& spacing);

/// Periodic box from the origin, without boundaries.
template <int dim>
FlowDomain<dim> periodic_nodes(const Vector<dim>& extent, const NodeSpacing& spacing);

/// Box 0 <= x <= length, 0 <= y <= height: walls at the bottom and the sides, free surface on top
/// (patches 0 and 1); or free surface all around (patch 0).
FlowDomain<2> column_nodes(double length, double height, const NodeSpacing& spacing);
FlowDomain<2> free_patch_nodes(double length, const NodeSpacing& spacing);

/// Pipe along x, 0 <= x <= length, axis at y = z = 0: patches 0 wall, 1 inlet, 2 outlet.
FlowDomain<3> pipe_nodes(double length, double radius, bool is_periodic,
                         const NodeSpacing& spacing);

/// A piece of the outline of a plane domain: a fine polyline with the fluid on its left, and the
/// patch it belongs to. Nodes are placed on it at equal distances.
struct OutlinePiece {
  std::int32_t patch = 0;
  std::vector<Vector<2>> points;  // [m] at least two; the last is the first of the next piece
};
using OutlineLoop = std::vector<OutlinePiece>;  // closed

/// Any plane domain: nodes on the loops (the outer one counterclockwise, holes clockwise) and on a
/// lattice inside, at least 0.6 spacings from the outline. Where pieces meet, walls take the node.
/// @throws ParameterError if a loop is open, a piece is shorter than a spacing, or nothing is
/// inside
FlowDomain<2> outline_nodes(const std::vector<OutlineLoop>& loops, std::vector<Patch<2>> patches,
                            const NodeSpacing& spacing);

/// Channel with a circular cylinder in the middle of its height: patch 4 is the cylinder.
FlowDomain<2> cylinder_nodes(double length, double height, double radius, double centre_x,
                             bool is_periodic, const NodeSpacing& spacing);

/// Channel whose height shrinks smoothly, by a cosine of the given length, to `throat` in its
/// middle.
FlowDomain<2> constriction_nodes(double length, double height, double throat,
                                 double constriction_length, const NodeSpacing& spacing);

/// Channel of `height` that splits symmetrically into two branches around a divider with a round
/// nose at x = nose, `divider` thick; walls and divider end at x = length, where both branches have
/// an outlet (patches 3 and 5); patch 4 is the divider.
FlowDomain<2> bifurcation_nodes(double length, double height, double nose, double divider,
                                const NodeSpacing& spacing);

}  // namespace hemoscale::micro
