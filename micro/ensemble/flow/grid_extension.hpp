#pragma once

#include <optional>
#include <vector>

#include "micro/ensemble/flow/grid_samples.hpp"
#include "micro/ensemble/flow/wall_geometry.hpp"

namespace hemoscale::micro {

/// Layers of nodes around the fluid to which a flow is continued.
constexpr int extension_layers = 3;

/// The velocities with those continued into the first layers of nodes outside the fluid, so that
/// differences across a wall see a smooth flow and a membrane node slightly beyond it still moves
/// sensibly. Each is the value of a quadratic polynomial, fitted by weighted least squares to the
/// nodes in the fluid around the nearest of them; given walls add points at rest. The error is of
/// third order in the spacing. Where there are too few points for a quadratic, it is the one of
/// least norm. Nodes further out stay without velocity.
///
/// @param walls  null: unknown; the flow is then continued without regard to them
std::vector<std::optional<Vector<2>>> extended(const GridSamples& samples,
                                               const WallGeometry* walls);

}  // namespace hemoscale::micro
