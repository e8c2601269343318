#include "micro/ensemble/packing/lattice_packing.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "micro/cells/outline_checks.hpp"
#include "micro/ensemble/packing/area_fraction.hpp"
#include "micro/ensemble/packing/draws.hpp"
#include "micro/ensemble/packing/insertion.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

/// Extents of a cell at any angle within the tilt of the orientation [m]. Between two of the angles
/// looked at, an extent exceeds both by less than 1 / cos of half their distance.
Vector<2> extents(std::span<const Vector<2>> outline, const LatticeOptions& o) {
  constexpr int angles = 129;
  Vector<2> largest = Vector<2>::Zero();
  const double between = 2 * o.tilt / (angles - 1);
  for (int k = 0; k < angles; ++k) {
    Vector<2> low = Vector<2>::Zero();
    Vector<2> high = Vector<2>::Zero();
    for (const Vector<2>& node :
         placed(outline, Vector<2>::Zero(), o.orientation - o.tilt + k * between)) {
      low = low.cwiseMin(node);
      high = high.cwiseMax(node);
    }
    // Sites are centred on the origin of the outline.
    largest = largest.cwiseMax(2 * high.cwiseMax(-low));
  }
  return largest / std::cos(0.5 * between);
}

struct Gaps {
  double along = 0, across = 0;  // [m]
  double smaller() const { return std::min(along, across); }
};

Gaps gaps(const LatticeShape& shape, const Vector<2>& extent, const Box& box, double wall_gap) {
  const double height = box.walls ? box.height - 2 * wall_gap : box.height;
  return {box.length / static_cast<double>(shape.columns) - extent.x(),
          height / static_cast<double>(shape.rows) - extent.y()};
}

/// The lattice with sites enough whose smaller gap is largest.
LatticeShape roomiest(std::size_t cells, const Vector<2>& extent, const Box& box, double wall_gap) {
  LatticeShape best{1, cells};
  double widest = std::numeric_limits<double>::lowest();
  for (std::size_t rows = 1; rows <= cells; ++rows) {
    const LatticeShape shape{rows, (cells + rows - 1) / rows};
    const Gaps g = gaps(shape, extent, box, wall_gap);
    if (g.smaller() > widest) {
      widest = g.smaller();
      best = shape;
    }
    if (g.across < g.along) break;  // more rows only narrow the gap across
  }
  return best;
}

/// Sites of which every one leaves the gap.
LatticeShape fullest(const Vector<2>& extent, const Box& box, const LatticeOptions& o) {
  const double height = box.walls ? box.height - 2 * o.wall_gap : box.height;
  const auto count = [&](double room, double size) {
    return room < size ? 0 : static_cast<std::size_t>(room / size);
  };
  return {count(height, extent.y() + o.gap), count(box.length, extent.x() + o.gap)};
}

void require_admissible(std::span<const Vector<2>> outline, const Box& box,
                        const LatticeOptions& o) {
  const auto require = [](bool holds, const std::string& message) {
    if (!holds) throw ParameterError("lattice of cells: " + message);
  };
  require(
      o.cells >= 1 && outline.size() >= 3,
      fmt::format("{} cells of {} nodes; at least one cell and three nodes are needed; give them",
                  o.cells, outline.size()));
  require(box.length > 0 && box.height > 0 && std::isfinite(box.area()),
          fmt::format("a box of {} m by {} m; both must be finite and positive; correct them",
                      box.length, box.height));
  require(o.tilt >= 0 && o.tilt <= std::numbers::pi / 2 && o.gap >= 0 && o.wall_gap >= 0,
          fmt::format("tilt {} rad, gap {} m, gap from walls {} m; the tilt must lie in [0, pi/2] "
                      "and gaps must not be negative; correct them",
                      o.tilt, o.gap, o.wall_gap));
  require(
      !o.shape || (o.shape->rows >= 1 && o.shape->columns >= 1 &&
                   o.shape->rows * o.shape->columns >= o.cells),
      fmt::format("{} rows and {} columns for {} cells; there must be a site for each; give more",
                  o.shape ? o.shape->rows : 0, o.shape ? o.shape->columns : 0, o.cells));
}

}  // namespace

LatticePacking pack_on_lattice(std::span<const Vector<2>> outline, const Box& box,
                               const LatticeOptions& options, std::uint64_t seed,
                               std::uint64_t stream) {
  require_admissible(outline, box, options);
  const Vector<2> extent = extents(outline, options);
  LatticePacking packing;
  packing.shape = options.shape.value_or(roomiest(options.cells, extent, box, options.wall_gap));
  const Gaps g = gaps(packing.shape, extent, box, options.wall_gap);
  packing.gap_along = g.along;
  packing.gap_across = g.across;
  if (!(g.smaller() >= options.gap)) {
    const LatticeShape most = fullest(extent, box, options);
    throw ParameterError(fmt::format(
        "lattice of cells: {}; on {} rows and {} columns, cells of {:.4g} m by {:.4g} m (with a "
        "tilt of up to {:.3g} degrees) are left gaps of {:.3g} m along and {:.3g} m across, and "
        "{:.3g} m is needed; {} rows and {} columns, {} cells, fit; reduce tilt or gap, {}",
        describe_fraction(options.cells, enclosed_area(outline), box), packing.shape.rows,
        packing.shape.columns, extent.x(), extent.y(), options.tilt * 180 / std::numbers::pi,
        g.along, g.across, options.gap, most.rows, most.columns, most.rows * most.columns,
        fraction_remedy(options.cells, box)));
  }
  const double site_x = extent.x() + g.along;
  const double site_y = extent.y() + g.across;
  const double bottom = box.walls ? options.wall_gap : 0;
  Draws draws(seed, stream);
  for (std::size_t cell = 0; cell < options.cells; ++cell) {
    const auto column = static_cast<double>(cell / packing.shape.rows);
    const auto row = static_cast<double>(cell % packing.shape.rows);
    const Vector<2> centre((column + 0.5) * site_x, bottom + (row + 0.5) * site_y);
    const double angle = options.orientation + draws.between(-options.tilt, options.tilt);
    append_cell(placed(outline, centre, angle), packing.state);
  }
  return packing;
}

}  // namespace hemoscale::micro
