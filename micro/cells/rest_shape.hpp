#pragma once

#include <cstdint>
#include <vector>

#include "micro/cells/membrane.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// A circle that is deflated at constant perimeter, to a minimum of its bending energy at every
/// area on the way [Tsubota2006, section 3.1]. The circle is a regular polygon whose segments keep
/// their length.
///
/// The reduced area compares the polygon with the regular one of the same segments,
/// A / A_regular, A_regular = P^2 / (4 n tan(pi/n)): 1 is the start. The smooth curve through the
/// nodes has the same reduced area 4 pi A / P^2 up to second order in the spacing, within 6e-4 at
/// 59 nodes; the polygon's own is smaller by (pi/n)^2 / 3, 0.1 %.
struct Deflation {
  double perimeter = 0;     // [m] P of the polygon, kept segment by segment
  double reduced_area = 0;  // [-] (0, 1]; opposite sides of the minimum touch at about 0.27
  BendingLaw bending_law = BendingLaw::turning_angle;
  std::uint64_t seed = 1;  // of the disturbance that makes the circle buckle; the result does not
                           // depend on it
};

struct RestShape {
  std::vector<Vector<2>> nodes;  // [m] counter-clockwise, centred, long axis along x, node 0 on +x
  double bending_energy = 0;     // [-] in units of kappa / R0, R0 = P / (2 pi); a circle has pi
  double largest_residual = 0;   // [-] of the conditions of the minimum, in the same units
};

/// The minimum of the bending energy of a closed chain of n equal segments at a given area, by
/// Newton's method in the directions of the segments; takes a fraction of a millisecond at 59
/// nodes.
/// @param nodes  at least 8
/// @throws ParameterError for values that are not admissible, or a reduced area at which opposite
///         sides would pass through each other
/// @throws NumericalError if a minimum is not reached
RestShape deflate(const Deflation& deflation, int nodes);

}  // namespace hemoscale::micro
