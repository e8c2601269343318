#pragma once

#include <memory>
#include <vector>

#include "micro/ensemble/box.hpp"
#include "micro/ensemble/flow/openings.hpp"
#include "micro/ensemble/flow/wall_geometry.hpp"

namespace hemoscale::micro {

/// Where cells may be, and where they have images. Either a box, or the fluid between general
/// walls.
struct CellRoom {
  double length = 0;         // [m] period along x; 0: none
  double height = 0;         // [m] of the channel between two plane walls, or period along y
  bool plane_walls = false;  // at y = 0 and y = height
  double image_offset = 0;   // [m] displacement along x of the image above
  std::shared_ptr<const WallGeometry> geometry = nullptr;  // general walls
  std::vector<Opening> openings = {};                      // where a room with general walls ends

  bool repeats_along_y() const { return height > 0 && !plane_walls; }
};

inline CellRoom room_of(const Box& box, double image_offset = 0) {
  return {.length = box.length,
          .height = box.height,
          .plane_walls = box.walls,
          .image_offset = image_offset};
}

}  // namespace hemoscale::micro
