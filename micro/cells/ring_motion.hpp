#pragma once

#include "micro/cells/ring_curve.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// How the membrane of one cell moves. Counter-clockwise is positive: in the shear u = G y, G > 0,
/// membranes turn clockwise and the rates are negative.
struct RingMotion {
  Vector<2> velocity = Vector<2>::Zero();  // [m/s] of the centroid of the area
  double tangential_speed = 0;  // [m/s] V = (1/P) closed int (u - velocity) . t ds, along the ring
  double treading_rate = 0;  // [rad/s] 2 pi V / P: of tank-treading, in a frame that does not turn
  double inclination_rate = 0;  // [rad/s] of the long axis (see RingShape); nan for a cell without
                                // one. Zero in steady tank-treading, the treading rate on average
                                // for a cell that tumbles as a rigid body
  // Velocity left when the closest motion of a rigid body (least squares over the arc length) is
  // taken away; zero for a steady parachute.
  double rigid_rate = 0;        // [rad/s] of that body
  double relative_speed = 0;    // [m/s] root of the mean square over the arc length
  double largest_relative = 0;  // [m/s] at the nodes
};

/// @param curve       through the positions of the nodes
/// @param velocities  the curve through their velocities
/// @throws ParameterError unless both have the same number of nodes
RingMotion measure_motion(const RingCurve& curve, const RingCurve& velocities);

}  // namespace hemoscale::micro
