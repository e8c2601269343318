#pragma once

#include <span>
#include <vector>

#include "micro/cells/ring_curve.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

// Distances between the curves through the nodes, to 1e-6 of the extent of the cell. The error of
// the curves themselves, of fourth order in the spacing of the nodes, comes on top.

/// Smallest distance between the outline of a cell and a wall given by its corners [m]; zero where
/// they cross.
/// @param wall  at least two points, an open line
/// @throws ParameterError
double gap(const RingCurve& cell, std::span<const Vector<2>> wall);

/// Smallest distance between the outlines of two cells [m]; zero where they cross. A cell inside
/// another one has a distance, too.
double gap(const RingCurve& cell, const RingCurve& other);

/// Smallest distance of a point from an outline [m].
double distance_to(const RingCurve& curve, const Vector<2>& point);

/// What is made equal before two outlines are compared.
enum class Alignment {
  none,
  along_flow,  // x of the centroids: cells that have travelled differently far
  both         // x and y of the centroids: the shape alone
};

/// The largest distance of any point of one outline from the other outline, in both directions (the
/// distance of Hausdorff between the curves) [m]. Which node lies where does not matter.
///
/// The points are eight on each segment: between them the distance can be larger by the curvature
/// of the difference alone.
double largest_distance(const RingCurve& a, const RingCurve& b, Alignment alignment);

/// Largest distance between an outline and its mirror image about the line along the flow through
/// its centroid [m]: zero for a symmetric parachute, wherever it is.
double asymmetry(const RingCurve& curve);

}  // namespace hemoscale::micro
