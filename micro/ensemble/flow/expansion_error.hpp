#pragma once

#include <vector>

#include "micro/ensemble/flow/given_flow.hpp"

namespace hemoscale::micro {

/// What one expansion for a whole cell costs: the largest |u(x + d) - expansion about x at d| over
/// the points x and 16 directions of |d| = radius and radius / 2 [m/s]. Zero for parabolic flows.
///
/// @param radius  [m] largest distance of a membrane node from the frame of its cell
/// @param points  [m] where cells may be
/// @throws ParameterError for a radius that is not positive or no points
double expansion_error(const GivenFlow& flow, double time, double radius,
                       const std::vector<Vector<2>>& points);

/// The flow at a distance d from the point of an expansion [m/s].
Vector<2> velocity_at(const LocalFlow& flow, const Vector<2>& d);

}  // namespace hemoscale::micro
