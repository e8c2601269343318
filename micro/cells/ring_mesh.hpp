#pragma once

#include <vector>

#include "micro/cells/membrane.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// A closed ring of nodes, counter-clockwise, and the shape at which its energies vanish. Segment i
/// joins node i to node i + 1, and the last node to the first.
struct RingMesh {
  int nodes = 0;
  std::vector<double> rest_length;    // [m] of segment i
  std::vector<double> node_length;    // [m] mean of the two segments at node i
  std::vector<double> natural_angle;  // [rad] turning angle theta0 at node i, left turns positive
  std::vector<double> natural_half_tangent;  // [-] tan(theta0 / 2)
  double rest_area = 0;                      // [m^2]
  double rest_perimeter = 0;                 // [m]
};

/// The ring whose reference shape is the given polygon.
/// @param spontaneous_curvature  [1/m] c0 of NaturalShape::curvature: theta0 = c0 times the mean
///                               length of the two segments at a node; 0 for the other shapes
/// @throws ParameterError unless there are at least three nodes, counter-clockwise, no two
///         neighbours in the same place; for a curvature that turns by pi or more at a node
RingMesh make_ring_mesh(const std::vector<Vector<2>>& polygon, NaturalShape natural_shape,
                        double spontaneous_curvature = 0);

}  // namespace hemoscale::micro
