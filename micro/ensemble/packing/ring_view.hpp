#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "micro/ensemble/packing/near_cells.hpp"
#include "micro/ensemble/state.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// The nodes of one cell where they are stored.
struct RingView {
  std::span<const double> x, y;  // [m]

  std::size_t nodes() const { return x.size(); }
  Vector<2> node(std::size_t i) const { return {x[i], y[i]}; }
};

inline RingView ring_of(const EnsembleState& state, std::size_t cell) {
  return {std::span(state.x).subspan(cell * state.nodes, state.nodes),
          std::span(state.y).subspan(cell * state.nodes, state.nodes)};
}

/// Whether a point lies inside a ring, by the even-odd rule along the ray to the right; on the
/// outline either is possible.
bool contains(const RingView& ring, const Vector<2>& point);

/// Looks for a place where a segment of one ring crosses or touches one of another, displaced ring;
/// segments that lie on one line do not count. Only segments in the common part of both bounds are
/// compared. Keeps its memory from one pair of rings to the next.
class CrossingSearch {
 public:
  struct Segment {
    Vector<2> begin, end;  // [m]
    Bounds bounds;
  };

  std::optional<Vector<2>> operator()(const RingView& one, const RingView& other,
                                      const Vector<2>& displacement, const Bounds& common);

 private:
  std::vector<Segment> mine_, theirs_;
};

}  // namespace hemoscale::micro
