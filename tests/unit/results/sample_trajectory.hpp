#pragma once

#include <cstddef>
#include <cstdint>

#include "micro/snapshot/trajectory_file.hpp"

namespace hemoscale::tests {

/// Two dimensions, rings of a common number of nodes, velocities, two observables.
inline micro::TrajectoryLayout sample_layout(std::int64_t rings = 3, std::int64_t nodes = 8) {
  micro::TrajectoryLayout layout;
  layout.author = "tester";
  layout.creator_version = "1.2.3";
  layout.nodes_per_ring.assign(static_cast<std::size_t>(rings), nodes);
  layout.box_edges = {40e-6, 20e-6};
  layout.is_periodic = {true, false};
  layout.has_velocities = true;
  layout.observables = {{"shear_stress", "Pa"}, {"area_error", ""}};
  return layout;
}

/// A frame whose every number tells where it belongs.
inline micro::StoredFrame sample_frame(const micro::TrajectoryLayout& layout, std::int64_t step) {
  micro::StoredFrame frame;
  frame.step = step;
  frame.time = 0.1 * static_cast<double>(step);
  frame.box_offset = 1e-7 * static_cast<double>(step);
  const auto values = static_cast<std::size_t>(layout.particle_count() * layout.dimension);
  for (std::size_t k = 0; k < values; ++k) {
    frame.positions.push_back(1e-6 * (static_cast<double>(step) + 0.001 * static_cast<double>(k)));
    if (layout.has_velocities) frame.velocities.push_back(-3 * frame.positions.back());
  }
  for (std::size_t k = 0; k < layout.observables.size(); ++k) {
    frame.observables.push_back(static_cast<double>(step) / (1.0 + static_cast<double>(k)));
  }
  return frame;
}

inline void append(micro::TrajectoryWriter& writer, const micro::StoredFrame& frame) {
  writer.append({frame.step, frame.time, frame.positions, frame.velocities, frame.box_offset,
                 frame.observables});
}

inline bool are_equal(const micro::StoredFrame& left, const micro::StoredFrame& right) {
  return left.step == right.step && left.time == right.time && left.positions == right.positions &&
         left.velocities == right.velocities && left.box_offset == right.box_offset &&
         left.observables == right.observables;
}

}  // namespace hemoscale::tests
