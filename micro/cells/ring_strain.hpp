#pragma once

#include <span>

#include "micro/cells/ring_mesh.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Lengths and area of a ring of nodes against those at rest. All are of the polygon, as in the
/// membrane laws: what a law keeps exactly has no error here.
struct RingStrain {
  double smallest_stretch = 0;  // [-] l_i / l0_i over the segments
  double largest_stretch = 0;   // [-]
  double mean_stretch = 0;      // [-] perimeter over perimeter at rest
  double length_error = 0;      // [-] largest |l_i / l0_i - 1|
  double perimeter_error = 0;   // [-] P / P0 - 1
  double area_error = 0;        // [-] A / A0 - 1
};

/// @param nodes  [m]
/// @throws ParameterError unless there is one node for each of the mesh
RingStrain measure_strain(std::span<const Vector<2>> nodes, const RingMesh& mesh);

}  // namespace hemoscale::micro
