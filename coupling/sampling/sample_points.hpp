#pragma once

#include <Eigen/Core>
#include <vector>

#include "macro/vector.hpp"

namespace hemoscale::coupling {

/// Points on the line from the axis of a channel to its wall, so spaced that the shear rates of a
/// parabolic velocity are spread evenly in their logarithm. With s the distance from the axis over
/// that of the wall, the shear rate of a parabola is proportional to s, hence
///
///   s_k = s_0^(1 - k / (N - 1)),   k = 0 ... N - 1,   from s_0 = closest_to_axis to s = 1.
///
/// The last point is `wall` itself, bit for bit; a single point is the wall.
///
/// @param axis             a point of the axis [m]
/// @param wall             the nearest point of the wall [m]
/// @param count            N, at least 1
/// @param closest_to_axis  s_0 [-], between 0 and 1, both excluded if there are several points
/// @throws CaseError naming sampling.across or sampling.closest_to_axis
template <int dim>
std::vector<macro::Vector<dim>> points_across(const macro::Vector<dim>& axis,
                                              const macro::Vector<dim>& wall, int count,
                                              double closest_to_axis);

/// Points given by the user as three coordinates, for a flow of `dim` dimensions.
/// @throws CaseError naming sampling.points: not finite, or in a plane flow a third coordinate that
///         is not zero; all such points at once
template <int dim>
std::vector<macro::Vector<dim>> explicit_points(const std::vector<Eigen::Vector3d>& points);

}  // namespace hemoscale::coupling
