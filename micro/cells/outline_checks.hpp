#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Nodes joined one after the other: closed, as the outline of a cell, or open, as a wall. Segment
/// i leads from node i to the next.
struct Chain {
  std::span<const Vector<2>> nodes;
  bool closed = true;
  std::size_t segments() const { return closed ? nodes.size() : nodes.size() - 1; }
  const Vector<2>& end(std::size_t segment) const { return nodes[(segment + 1) % nodes.size()]; }
};

/// Two segments that share a point.
struct Meeting {
  std::size_t first = 0;   // segment of the first chain
  std::size_t second = 0;  // segment of the second chain, or of the same
  Vector<2> place = {0, 0};
};

/// Where two chains come closest: at a node of one of them.
struct Approach {
  double distance = 0;   // [m]
  bool of_first = true;  // the node belongs to the first chain, the segment to the second; or else
  std::size_t node = 0;
  std::size_t segment = 0;
  Vector<2> place = {0, 0};  // of the node
};

/// Enclosed area, positive for counter-clockwise nodes [m^2].
double enclosed_area(std::span<const Vector<2>> ring);

/// The first node whose next one lies at the same place, or one that is not finite.
std::optional<std::size_t> coincident_neighbours(std::span<const Vector<2>> ring);

/// Two segments of a ring that touch or cross though they are not neighbours. Compares all pairs:
/// O(n^2), 8 us for 59 nodes.
std::optional<Meeting> self_crossing(std::span<const Vector<2>> ring);

/// Two segments of different chains that touch or cross.
std::optional<Meeting> crossing(const Chain& first, const Chain& second);

/// Whether a point lies inside a ring (even-odd rule); on the outline either is possible.
bool encloses(std::span<const Vector<2>> ring, const Vector<2>& point);

/// Smallest distance between two chains that do not cross, if it is at most `reach`. Chains whose
/// bounding boxes are farther apart cost nothing.
/// @param reach  [m] positive, infinity for any distance
std::optional<Approach> closest(const Chain& first, const Chain& second, double reach);

/// Smallest distance across a ring: between a node and a segment that the outline joins, either way
/// round, only by more than twice their distance. Along a bend of constant radius that is at most
/// pi/2 times: neighbours and points of one bend do not count, and nothing is found in a circle.
std::optional<Approach> closest_across(std::span<const Vector<2>> ring);

/// What is wrong with the outlines of cells before a run: one line each with cells, nodes, place
/// and remedy; empty if nothing is. Looks for nodes that are not finite or coincide, clockwise
/// rings, rings that cross themselves, each other or a wall, and rings inside each other.
std::vector<std::string> outline_faults(std::span<const std::vector<Vector<2>>> rings,
                                        std::span<const Chain> walls);

/// @throws ParameterError with all lines of outline_faults
void require_separate(std::span<const std::vector<Vector<2>>> rings, std::span<const Chain> walls);

}  // namespace hemoscale::micro
