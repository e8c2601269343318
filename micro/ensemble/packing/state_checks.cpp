#include "micro/ensemble/packing/state_checks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "micro/ensemble/packing/near_cells.hpp"
#include "micro/ensemble/packing/ring_view.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

constexpr std::size_t most_lines = 5;  // of each fault

/// A cell by its kind and its number within it.
struct Member {
  std::size_t kind, cell;
};

std::vector<Member> members_of(std::span<const EnsembleState> kinds) {
  std::vector<Member> all;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    for (std::size_t cell = 0; cell < kinds[kind].cells; ++cell) all.push_back({kind, cell});
  }
  return all;
}

RingView ring_of(std::span<const EnsembleState> kinds, const Member& m) {
  return micro::ring_of(kinds[m.kind], m.cell);
}

std::vector<Bounds> bounds_of_all(std::span<const EnsembleState> kinds) {
  std::vector<Bounds> all;
  for (const EnsembleState& state : kinds) {
    const std::vector<Bounds> more = bounds_of(state);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

/// Lines of one fault; the rest is counted.
class Lines {
 public:
  explicit Lines(std::string remedy) : remedy_(std::move(remedy)) {}
  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    if (++count_ <= most_lines) {
      lines_.push_back(fmt::format(format, std::forward<Values>(values)...) + "; " + remedy_);
    }
  }
  void append_to(std::vector<std::string>& all) const {
    all.insert(all.end(), lines_.begin(), lines_.end());
    if (count_ > most_lines) {
      all.push_back(
          fmt::format("and {} more like the last, {} in all", count_ - most_lines, count_));
    }
  }
  bool empty() const { return count_ == 0; }

 private:
  std::string remedy_;
  std::vector<std::string> lines_;
  std::size_t count_ = 0;
};

/// First node that is not finite.
std::optional<std::size_t> broken_node(const RingView& ring) {
  for (std::size_t i = 0; i < ring.nodes(); ++i) {
    if (!std::isfinite(ring.x[i]) || !std::isfinite(ring.y[i])) return i;
  }
  return std::nullopt;
}

/// The node that is deepest in a wall, and how deep [m].
struct Deepest {
  std::size_t node = 0;
  double depth = std::numeric_limits<double>::lowest();
};

Deepest deepest_in_wall(const RingView& ring, const CellRoom& room) {
  Deepest deepest;
  for (std::size_t i = 0; i < ring.nodes(); ++i) {
    double depth = deepest.depth;
    if (room.plane_walls) depth = std::max(-ring.y[i], ring.y[i] - room.height);
    if (room.geometry) depth = std::max(depth, -room.geometry->at(ring.node(i)).distance);
    if (depth > deepest.depth) deepest = {i, depth};
  }
  return deepest;
}

Vector<2> mean_of(const RingView& ring) {
  Vector<2> sum = Vector<2>::Zero();
  for (std::size_t i = 0; i < ring.nodes(); ++i) sum += ring.node(i);
  return sum / static_cast<double>(ring.nodes());
}

}  // namespace

std::vector<Overlap> overlaps(std::span<const EnsembleState> kinds, const CellRoom& room) {
  const std::vector<Member> members = members_of(kinds);
  const NearCells near(bounds_of_all(kinds), room);
  std::vector<Overlap> found;
  CrossingSearch crossing;
  for (std::size_t a = 0; a < members.size(); ++a) {
    const Bounds& box = near.bounds()[a];
    const RingView ring = ring_of(kinds, members[a]);
    near.meeting(box, [&](std::size_t b, const Vector<2>& displacement) {
      // Every pair once: of two images of one cell the one to the right or above.
      const bool is_image = displacement.x() > 0 || (displacement.x() == 0 && displacement.y() > 0);
      if (b < a || (b == a && !is_image)) return;
      const Bounds other_box = near.bounds()[b].moved(displacement);
      const Bounds common{std::max(box.left, other_box.left), std::min(box.right, other_box.right),
                          std::max(box.lower, other_box.lower),
                          std::min(box.upper, other_box.upper)};
      const RingView other = ring_of(kinds, members[b]);
      Overlap overlap{members[a].kind, members[a].cell, members[b].kind, members[b].cell};
      if (const auto place = crossing(ring, other, displacement, common)) {
        overlap.crosses = true;
        overlap.place = *place;
        found.push_back(overlap);
      } else if (box.holds(other_box) && contains(ring, other.node(0) + displacement)) {
        overlap.place = mean_of(other) + displacement;
        found.push_back(overlap);
      } else if (other_box.holds(box) && contains(other, ring.node(0) - displacement)) {
        overlap.place = mean_of(ring);
        found.push_back(overlap);
      }
    });
  }
  return found;
}

std::vector<std::string> state_faults(std::span<const EnsembleState> kinds, const CellRoom& room) {
  Lines broken("give finite coordinates");
  Lines beyond("move the cell into the fluid, or correct the walls");
  Lines gone("leave it out, or move the opening");
  Lines overlapping("move one of them, lower the area fraction or pack anew");
  for (const Member& m : members_of(kinds)) {
    const RingView ring = ring_of(kinds, m);
    if (const auto node = broken_node(ring)) {
      broken.add("kind {}, cell {}: node {} lies at ({}, {}) m", m.kind, m.cell, *node,
                 ring.x[*node], ring.y[*node]);
      continue;
    }
    const Deepest deepest = deepest_in_wall(ring, room);
    if (deepest.depth > 0) {
      beyond.add("kind {}, cell {}: node {} at ({:.4g}, {:.4g}) m lies {:.3g} m beyond a wall",
                 m.kind, m.cell, deepest.node, ring.x[deepest.node], ring.y[deepest.node],
                 deepest.depth);
    }
    const Vector<2> middle = mean_of(ring);
    for (const Opening& opening : room.openings) {
      if (has_left(opening, middle, std::numeric_limits<double>::infinity())) {
        gone.add("kind {}, cell {}: its centre ({:.4g}, {:.4g}) m lies {:.3g} m beyond opening {}",
                 m.kind, m.cell, middle.x(), middle.y(), -depth(opening, middle), opening.name);
      }
    }
  }
  std::vector<std::string> all;
  broken.append_to(all);
  beyond.append_to(all);
  gone.append_to(all);
  if (broken.empty()) {
    for (const Overlap& o : overlaps(kinds, room)) {
      const bool is_own_image = o.kind == o.other_kind && o.cell == o.other_cell;
      overlapping.add(
          "kind {}, cell {} and {} {} at ({:.4g}, {:.4g}) m", o.kind, o.cell,
          is_own_image ? std::string("an image of itself")
                       : fmt::format("kind {}, cell {}", o.other_kind, o.other_cell),
          o.crosses ? "interlock: their outlines cross" : "overlap: one lies inside the other",
          o.place.x(), o.place.y());
    }
    overlapping.append_to(all);
  }
  return all;
}

void require_sound(std::span<const EnsembleState> kinds, const CellRoom& room) {
  std::string text;
  for (const std::string& line : state_faults(kinds, room)) text += "\n" + line;
  if (!text.empty()) throw ParameterError("initial state of the ensemble:" + text);
}

}  // namespace hemoscale::micro
