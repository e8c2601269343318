#include "micro/ensemble/interpenetration.hpp"

#include <vector>

#include "micro/ensemble/packing/near_cells.hpp"
#include "micro/ensemble/packing/ring_view.hpp"

namespace hemoscale::micro {
namespace {

/// Nodes of `other`, displaced, inside `ring`.
std::size_t count_inside(const RingView& ring, const Bounds& bounds, const RingView& other,
                         const Vector<2>& displacement) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < other.nodes(); ++i) {
    const Vector<2> node = other.node(i) + displacement;
    if (node.x() > bounds.left && node.x() < bounds.right && node.y() > bounds.lower &&
        node.y() < bounds.upper && contains(ring, node)) {
      ++count;
    }
  }
  return count;
}

}  // namespace

std::size_t count_interpenetrating_nodes(std::span<const EnsembleState> kinds,
                                         const CellRoom& room) {
  std::vector<Bounds> bounds;
  std::vector<RingView> rings;
  for (const EnsembleState& state : kinds) {
    const std::vector<Bounds> more = bounds_of(state);
    bounds.insert(bounds.end(), more.begin(), more.end());
    for (std::size_t cell = 0; cell < state.cells; ++cell) rings.push_back(ring_of(state, cell));
  }
  const NearCells near(std::move(bounds), room);
  std::size_t count = 0;
  for (std::size_t cell = 0; cell < rings.size(); ++cell) {
    const Bounds& own = near.bounds()[cell];
    near.meeting(own, [&](std::size_t other, const Vector<2>& displacement) {
      const bool is_self = other == cell && displacement == Vector<2>::Zero();
      if (!is_self) count += count_inside(rings[cell], own, rings[other], displacement);
    });
  }
  return count;
}

std::size_t count_interpenetrating_nodes(const EnsembleState& state, const Box& box) {
  return count_interpenetrating_nodes(std::span(&state, 1), room_of(box, state.image_offset));
}

}  // namespace hemoscale::micro
