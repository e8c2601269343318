#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hemoscale::micro {

/// Everything that changes while an ensemble moves. Node k of cell c is entry c * nodes + k; every
/// cell is whole, and its centre lies in the box or has left it by a small part of it.
struct EnsembleState {
  std::size_t cells = 0;
  std::size_t nodes = 0;    // per cell
  std::vector<double> x;    // [m]
  std::vector<double> y;    // [m]
  double image_offset = 0;  // [m] displacement along x of the image above, in [0, length)
  double time = 0;          // [s]
  double strain = 0;        // [-] |shear rate| times time, accumulated
  std::int64_t step = 0;
};

}  // namespace hemoscale::micro
