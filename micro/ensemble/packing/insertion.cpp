#include "micro/ensemble/packing/insertion.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

bool contains(std::span<const Vector<2>> ring, const Vector<2>& point) {
  bool inside = false;
  for (std::size_t k = 0, before = ring.size() - 1; k < ring.size(); before = k++) {
    const Vector<2>& a = ring[before];
    const Vector<2>& b = ring[k];
    if ((a.y() > point.y()) != (b.y() > point.y())) {
      const double place = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      inside = inside != (point.x() < place);
    }
  }
  return inside;
}

}  // namespace

std::vector<Vector<2>> placed(std::span<const Vector<2>> outline, const Vector<2>& place,
                              double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  std::vector<Vector<2>> ring;
  ring.reserve(outline.size());
  for (const Vector<2>& node : outline) {
    ring.emplace_back(place.x() + c * node.x() - s * node.y(),
                      place.y() + s * node.x() + c * node.y());
  }
  return ring;
}

void append_cell(std::span<const Vector<2>> ring, EnsembleState& state) {
  state.nodes = ring.size();
  ++state.cells;
  for (const Vector<2>& node : ring) {
    state.x.push_back(node.x());
    state.y.push_back(node.y());
  }
}

Occupancy::Occupancy(const CellRoom& room, const Clearance& clearance, double largest_cell)
    : room_(room), clearance_(clearance) {
  const auto admissible = [](double v) { return v >= 0 && std::isfinite(v); };
  if (!admissible(clearance.cells) || !admissible(clearance.walls) || !admissible(largest_cell) ||
      largest_cell == 0) {
    throw ParameterError(
        fmt::format("insertion of cells: clearance {} m between cells and {} m from walls, largest "
                    "cell {} m; they must be finite, and the last one positive; correct them",
                    clearance.cells, clearance.walls, largest_cell));
  }
  const auto bins = [&](double period) {
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(period / largest_cell));
  };
  size_ = {largest_cell, largest_cell};
  if (room.length > 0) {
    columns_ = bins(room.length);
    size_.x() = room.length / static_cast<double>(columns_);
  }
  if (room.repeats_along_y()) {
    rows_ = bins(room.height);
    size_.y() = room.height / static_cast<double>(rows_);
  }
}

std::int64_t Occupancy::row_of(double y) const {
  return static_cast<std::int64_t>(std::floor(y / size_.y()));
}

/// Columns slide with the images of their row.
std::int64_t Occupancy::column_of(double x, std::int64_t row) const {
  const std::int64_t image =
      rows_ > 0 ? (row >= 0 ? row / rows_ : -((rows_ - 1 - row) / rows_)) : 0;
  return static_cast<std::int64_t>(
      std::floor((x - static_cast<double>(image) * room_.image_offset) / size_.x()));
}

Occupancy::Bin Occupancy::bin(std::int64_t column, std::int64_t row) const {
  Bin b;
  const auto wrap = [](std::int64_t& k, std::int64_t period) {
    const std::int64_t image = k >= 0 ? k / period : -((period - 1 - k) / period);
    k -= image * period;
    return static_cast<double>(image);
  };
  if (rows_ > 0) {
    const double image = wrap(row, rows_);
    b.displacement += image * Vector<2>(room_.image_offset, room_.height);
  }
  if (columns_ > 0) b.displacement.x() += wrap(column, columns_) * room_.length;
  b.key =
      (static_cast<std::uint64_t>(column) << 32U) ^ (static_cast<std::uint64_t>(row) & 0xffffffffU);
  return b;
}

Occupancy::Cell Occupancy::measured(std::span<const Vector<2>> ring) const {
  Cell cell;
  cell.nodes = ring.size();
  Vector<2> low = ring[0];
  Vector<2> high = ring[0];
  for (std::size_t i = 0; i < ring.size(); ++i) {
    low = low.cwiseMin(ring[i]);
    high = high.cwiseMax(ring[i]);
    cell.spacing = std::max(cell.spacing, (ring[(i + 1) % ring.size()] - ring[i]).norm());
  }
  cell.bounds = {low.x(), high.x(), low.y(), high.y()};
  return cell;
}

void Occupancy::add(std::span<const Vector<2>> ring) {
  Cell cell = measured(ring);
  const Vector<2> middle = cell.bounds.middle();
  const std::int64_t row = row_of(middle.y());
  const Bin home = bin(column_of(middle.x(), row), row);
  cell.bounds = cell.bounds.moved(-home.displacement);
  cell.first = nodes_.size();
  for (const Vector<2>& node : ring) nodes_.push_back(node - home.displacement);
  reach_ = reach_.cwiseMax(
      0.5 * Vector<2>(cell.bounds.right - cell.bounds.left, cell.bounds.upper - cell.bounds.lower));
  spacing_ = std::max(spacing_, cell.spacing);
  bins_[home.key].push_back(cells_.size());
  cells_.push_back(cell);
}

void Occupancy::add(const EnsembleState& state) {
  std::vector<Vector<2>> ring(state.nodes);
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    for (std::size_t i = 0; i < state.nodes; ++i) {
      const std::size_t k = cell * state.nodes + i;
      ring[i] = {state.x[k], state.y[k]};
    }
    add(ring);
  }
}

bool Occupancy::lies_in_fluid(std::span<const Vector<2>> ring) const {
  Vector<2> sum = Vector<2>::Zero();
  for (const Vector<2>& node : ring) {
    sum += node;
    if (room_.plane_walls &&
        (node.y() < clearance_.walls || node.y() > room_.height - clearance_.walls)) {
      return false;
    }
    if (room_.geometry && room_.geometry->at(node).distance < clearance_.walls) return false;
  }
  const Vector<2> centre = sum / static_cast<double>(ring.size());
  return std::none_of(room_.openings.begin(), room_.openings.end(), [&](const Opening& opening) {
    return has_left(opening, centre, std::numeric_limits<double>::infinity());
  });
}

bool Occupancy::is_apart(std::span<const Vector<2>> ring, const Cell& mine, const Cell& other,
                         const Vector<2>& displacement) const {
  const double least = std::max(clearance_.cells, 0.5 * (mine.spacing + other.spacing));
  const Bounds theirs = other.bounds.moved(displacement);
  if (!mine.bounds.grown(least).meets(theirs)) return true;
  const std::span<const Vector<2>> nodes(nodes_.data() + other.first, other.nodes);
  const auto is_in = [](const Bounds& b, const Vector<2>& p) {
    return p.x() > b.left && p.x() < b.right && p.y() > b.lower && p.y() < b.upper;
  };
  if (contains(nodes, ring[0] - displacement) || contains(ring, nodes[0] + displacement)) {
    return false;
  }
  std::vector<Vector<2>> facing;
  const Bounds near_mine = mine.bounds.grown(least).moved(-displacement);
  for (const Vector<2>& node : nodes) {
    if (is_in(near_mine, node)) facing.push_back(node + displacement);
  }
  const Bounds near_theirs = theirs.grown(least);
  for (const Vector<2>& node : ring) {
    if (!is_in(near_theirs, node)) continue;
    for (const Vector<2>& opposite : facing) {
      if ((node - opposite).squaredNorm() < least * least) return false;
    }
  }
  return true;
}

bool Occupancy::admits(std::span<const Vector<2>> ring) const {
  if (!lies_in_fluid(ring)) return false;
  const Cell mine = measured(ring);
  // An image of itself must be apart as well.
  const double least = std::max(clearance_.cells, mine.spacing);
  const double width = mine.bounds.right - mine.bounds.left;
  const double height = mine.bounds.upper - mine.bounds.lower;
  if ((room_.length > 0 && width + least > room_.length) ||
      (room_.repeats_along_y() && height + least > room_.height)) {
    return false;
  }
  const double margin = std::max(clearance_.cells, 0.5 * (mine.spacing + spacing_));
  const Bounds box = mine.bounds.grown(margin);
  for (std::int64_t row = row_of(box.lower - reach_.y()); row <= row_of(box.upper + reach_.y());
       ++row) {
    const std::int64_t last = column_of(box.right + reach_.x(), row);
    for (std::int64_t column = column_of(box.left - reach_.x(), row); column <= last; ++column) {
      const Bin b = bin(column, row);
      const auto found = bins_.find(b.key);
      if (found == bins_.end()) continue;
      for (const std::size_t k : found->second) {
        if (!is_apart(ring, mine, cells_[k], b.displacement)) return false;
      }
    }
  }
  return true;
}

EnsembleState insert_at_random(Occupancy& occupancy, std::span<const Vector<2>> outline,
                               std::size_t cells, const Bounds& region, Draws& draws,
                               int attempts) {
  EnsembleState state;
  state.nodes = outline.size();
  for (std::size_t cell = 0; cell < cells; ++cell) {
    bool is_placed = false;
    for (int attempt = 0; attempt < attempts && !is_placed; ++attempt) {
      const double x = draws.between(region.left, region.right);
      const double y = draws.between(region.lower, region.upper);
      const std::vector<Vector<2>> ring = placed(outline, {x, y}, draws.angle());
      if (!occupancy.admits(ring)) continue;
      occupancy.add(ring);
      append_cell(ring, state);
      is_placed = true;
    }
    if (!is_placed) return state;
  }
  return state;
}

std::optional<std::vector<Vector<2>>> free_place(const Occupancy& occupancy,
                                                 std::span<const Vector<2>> outline,
                                                 const Search& search) {
  struct Place {
    double along, back;
  };
  const auto count = [&](double reach) { return static_cast<int>(reach / search.step); };
  std::vector<Place> places;
  for (int i = -count(search.reach_along); i <= count(search.reach_along); ++i) {
    for (int j = 0; j <= count(search.reach_back); ++j) {
      places.push_back({i * search.step, j * search.step});
    }
  }
  // The order of equally distant places is the one above.
  std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return a.along * a.along + a.back * a.back < b.along * b.along + b.back * b.back;
  });
  for (const Place& place : places) {
    const Vector<2> centre = search.place + place.along * search.along + place.back * search.back;
    for (int k = 0; k < search.angles; ++k) {
      const double angle = search.angle + std::numbers::pi * k / search.angles;
      std::vector<Vector<2>> ring = placed(outline, centre, angle);
      if (occupancy.admits(ring)) return ring;
    }
  }
  return std::nullopt;
}

}  // namespace hemoscale::micro
