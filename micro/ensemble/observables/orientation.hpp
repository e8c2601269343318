#pragma once

#include <span>

#include "micro/ensemble/observables/cell_shape.hpp"

namespace hemoscale::micro {

/// How the long axes of cells lie. With a the inclination of a cell and <> the mean over cells:
///
///   along_flow = <cos 2a>                 1: all along x, 0: none preferred, -1: all across
///   angle = atan2(<sin 2a>, <cos 2a>)/2   direction that maximises <cos 2(a - angle)>
///   order = <cos 2(a - angle)> = hypot(<cos 2a>, <sin 2a>)
///
/// Axes have no direction, hence the double angle. In a channel the cells of the upper half are
/// mirrored (a -> -a), so that cells which lean with the shear in both halves count alike and the
/// angle is measured as in the lower half.
struct Orientation {
  double order = 0;       // [-] in [0, 1]
  double angle = 0;       // [rad] in (-pi/2, pi/2]
  double along_flow = 0;  // [-] in [-1, 1]
};

/// @param axis  height of the axis of a channel [m]; infinite if nothing is to be mirrored
/// @pre at least one cell
Orientation orientation(std::span<const CellShape> shapes, double axis);

}  // namespace hemoscale::micro
