#include "micro/ensemble/packing/platelets.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "micro/cells/outline.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

// In vain for one platelet. Gaps are a third of the room or more, and not all of them are too
// small.
constexpr int attempts = 20000;

void require_admissible(const PlateletParameters& p, double plasma_viscosity) {
  const auto positive = [](double v) { return v > 0 && std::isfinite(v); };
  if (!positive(p.length) || !positive(p.thickness) || p.thickness > p.length) {
    throw ParameterError(fmt::format(
        "platelets of {} m by {} m; both must be finite and positive, the length the larger; "
        "choose such as 2.5e-6 by 1e-6",
        p.length, p.thickness));
  }
  if (!positive(p.membrane.stretch_modulus) || !(p.membrane.bending_modulus >= 0) ||
      !(p.membrane.area_modulus >= 0) || !positive(p.drag.coefficient) ||
      !positive(plasma_viscosity)) {
    throw ParameterError(fmt::format(
        "platelets: stretch modulus {} N/m, bending modulus {} J, area modulus {} Pa, drag "
        "coefficient {}, plasma viscosity {} Pa s; moduli must not be negative, the others "
        "positive; "
        "correct them",
        p.membrane.stretch_modulus, p.membrane.bending_modulus, p.membrane.area_modulus,
        p.drag.coefficient, plasma_viscosity));
  }
}

}  // namespace

Platelets make_platelets(const PlateletParameters& p, double plasma_viscosity) {
  require_admissible(p, plasma_viscosity);
  Platelets platelets;
  platelets.outline = outline_nodes(
      {.outline = Outline::ellipse, .length = p.length, .aspect = p.thickness / p.length}, p.nodes);
  platelets.kind.mesh = make_ring_mesh(platelets.outline, p.membrane.natural_shape);
  platelets.kind.laws = make_membrane_laws(p.membrane);
  platelets.kind.node_drag = p.drag.coefficient * plasma_viscosity;
  if (p.drag.convention == DragConvention::cell) platelets.kind.node_drag /= p.nodes;
  return platelets;
}

std::size_t platelets_for(std::size_t red_cells, const PlateletParameters& parameters) {
  if (!(parameters.per_red_cell >= 0) || !std::isfinite(parameters.per_red_cell)) {
    throw ParameterError(
        fmt::format("platelets: {} for each red cell; the ratio must be finite and not negative; "
                    "blood has about 1/16",
                    parameters.per_red_cell));
  }
  return static_cast<std::size_t>(
      std::lround(static_cast<double>(red_cells) * parameters.per_red_cell));
}

EnsembleState place_in_gaps(std::span<const Vector<2>> outline, std::size_t count,
                            std::span<const EnsembleState> cells, const CellRoom& room,
                            const Bounds& region, const Clearance& clearance, std::uint64_t seed,
                            std::uint64_t stream) {
  double largest = 0;
  for (const Vector<2>& node : outline) largest = std::max(largest, 2 * node.norm());
  for (const EnsembleState& state : cells) {
    for (const Bounds& b : bounds_of(state)) {
      largest = std::max({largest, b.right - b.left, b.upper - b.lower});
    }
  }
  Occupancy occupancy(room, clearance, largest);
  for (const EnsembleState& state : cells) occupancy.add(state);
  Draws draws(seed, stream);
  EnsembleState placed = insert_at_random(occupancy, outline, count, region, draws, attempts);
  if (placed.cells == count) return placed;
  throw ParameterError(fmt::format(
      "platelets: {} of {} found a gap between the other cells in {} attempts each, {:.3g} m from "
      "them and {:.3g} m from walls; use fewer or smaller ones, a lower hematocrit or less "
      "clearance",
      placed.cells, count, attempts, clearance.cells, clearance.walls));
}

}  // namespace hemoscale::micro
