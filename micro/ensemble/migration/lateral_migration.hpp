#pragma once

#include <cstdint>
#include <optional>

#include "micro/ensemble/flow/given_flow.hpp"
#include "micro/ensemble/migration/shear_diffusion.hpp"
#include "micro/ensemble/migration/shear_lift.hpp"
#include "micro/ensemble/migration/wall_lift.hpp"

namespace hemoscale::micro {

/// Laws for what a given flow leaves out: with isotropic drag no cell changes its mean lateral
/// position by itself. Every law that is chosen adds a velocity to all nodes of a cell, so that it
/// moves without being deformed. All are off by default.
struct LateralMigration {
  std::optional<WallLift> wall_lift;
  std::optional<ShearLift> shear_lift;
  std::optional<ShearDiffusion> shear_diffusion;

  bool is_any() const { return wall_lift || shear_lift || shear_diffusion; }

  /// Displacement across a plane channel of a cell in a step [m].
  /// @param y     [m] height of its centre above the lower wall, 0 < y < height
  /// @param flow  there
  double displacement(double y, double height, const LocalFlow& flow, std::uint64_t cell,
                      std::uint64_t step, double time_step) const {
    const double shear_rate = flow.gradient(0, 1);
    double d = 0;
    if (wall_lift) d += time_step * wall_lift->velocity(y, height);
    if (shear_lift) d += time_step * shear_lift->velocity(y, height, shear_rate);
    if (shear_diffusion) {
      d += shear_diffusion->displacement(cell, step, shear_rate, flow.second[0](1, 1), time_step);
    }
    return d;
  }
};

}  // namespace hemoscale::micro
