#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "micro/observation.hpp"

namespace hemoscale::micro {

/// What an observer sees of an ensemble at one time. Every cell is whole; its centre lies in the
/// box. The image above the box is displaced by (image_offset, height).
struct EnsembleFrame {
  double time = 0;          // [s]
  double strain = 0;        // [-] accumulated |shear rate| times time (channel: largest shear rate)
  std::int64_t step = 0;    // [-]
  double length = 0;        // [m] of the box along x, periodic
  double height = 0;        // [m] of the box along y, periodic unless there are walls
  bool walls = false;       // at y = 0 and y = height
  double image_offset = 0;  // [m] in [0, length)
  std::vector<double> positions;       // [m] x0, y0, x1, y1, ...; nodes of a cell are consecutive
  std::vector<std::int32_t> cell_ids;  // [-] of each node
};

using FrameObserver = std::function<void(const EnsembleFrame&)>;

/// In which quantity the distance between frames is given.
enum class FrameClock { strain, time };

/// Profiles across a channel, in bins of equal height from wall to wall.
struct LateralProfile {
  std::vector<double> y;              // [m] middle of the bin
  std::vector<double> area_fraction;  // [-] of the cells
  std::vector<double>
      cell_velocity;           // [m/s] mean velocity of the nodes along x; 0 where there are none
  double cell_free_layer = 0;  // [m] mean distance from a wall to the nearest membrane
  double wall_pressure = 0;    // [Pa] mean force of the cells on a wall per area
};

/// Averages over one stretch of a scene without coupling.
struct SceneObservation {
  double time = 0;         // [s] at the end
  double duration = 0;     // [s] as run: whole steps
  std::int64_t steps = 0;  // [-] in this stretch
  Estimate
      shear_stress;  // [Pa] total; shear box only. Trust the error from some 50 effective samples
  Estimate first_normal_difference;                      // [Pa]
  Tensor<2> particle_stress = Tensor<2>::Zero();         // [Pa] mean, cells only
  std::optional<LateralProfile> profile = std::nullopt;  // channel only
  std::vector<LedgerEntry> ledger;
};

}  // namespace hemoscale::micro
