#pragma once

#include <string>
#include <vector>

#include "macro/vector.hpp"

namespace hemoscale::macro {

/// The boundary of a plane mesh as polylines in its plane, in SI; the fluid lies on the left of the
/// direction of travel. Holds no type of OpenFOAM.
struct MeshOutline {
  using Polyline = std::vector<Vector<2>>;  // [m]; closed if the last point is the first

  /// A patch through which fluid passes: every patch that is neither a wall nor empty.
  struct Opening {
    std::string patch;
    std::vector<Polyline> polylines;
  };

  std::vector<Polyline> walls;  // of all patches of type wall, joined where they meet
  std::vector<Opening> openings;
  double back = 0;   // [m] least z of the mesh
  double front = 0;  // [m] largest z of the mesh
};

}  // namespace hemoscale::macro
