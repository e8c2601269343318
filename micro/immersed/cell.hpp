#pragma once

#include <memory>
#include <vector>

#include "micro/cells/ring_membrane.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// One cell in the plasma: a ring of nodes and what it is made of.
struct Cell {
  std::shared_ptr<const RingMembrane> membrane;
  double viscosity_ratio = 1;         // [-] inside over outside
  std::vector<Vector<2>> positions;   // [m] of the nodes, counter-clockwise, never wrapped
  std::vector<Vector<2>> velocities;  // [m/s]
};

}  // namespace hemoscale::micro
