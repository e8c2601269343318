#pragma once

#include <span>
#include <vector>

#include "micro/cells/ring_curve.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// A part of the outline that lies inside the convex hull, under a chord that touches the curve at
/// both ends.
struct Concavity {
  Vector<2> first, second;  // [m] ends of the chord
  Vector<2> deepest;        // [m] point of the curve farthest from the chord
  Vector<2> outward;        // [-] unit normal of the chord, away from the cell
  double depth = 0;         // [m] of that point below the chord
  double area = 0;          // [m^2] between chord and curve
};

/// Concavities of a counter-clockwise curve in the order in which they follow each other; those
/// shallower than 1e-6 of the extent of the cell are not seen.
std::vector<Concavity> concavities(const RingCurve& curve);

/// Depth along a direction of the deepest concavity that faces it within 45 degrees; zero if none
/// does.
///
/// With (-1, 0) this is the rear dimple of a parachute that moves along +x: the distance along the
/// flow from the chord across its rear rims to the membrane between them.
/// @param direction  unit vector
double dimple_depth(std::span<const Concavity> concavities, const Vector<2>& direction);

/// Area over the area of the convex hull: 1 for a convex cell.
double convexity(double area, std::span<const Concavity> concavities);

}  // namespace hemoscale::micro
