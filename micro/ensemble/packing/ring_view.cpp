#include "micro/ensemble/packing/ring_view.hpp"

#include <algorithm>

namespace hemoscale::micro {
namespace {

double cross(const Vector<2>& a, const Vector<2>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

void select_segments(const Bounds& box, const RingView& ring, const Vector<2>& displacement,
                     std::vector<CrossingSearch::Segment>& found) {
  found.clear();
  const Bounds own = box.moved(-displacement);
  const std::size_t n = ring.nodes();
  for (std::size_t i = 0, before = n - 1; i < n; before = i++) {
    const double left = std::min(ring.x[before], ring.x[i]);
    const double right = std::max(ring.x[before], ring.x[i]);
    const double lower = std::min(ring.y[before], ring.y[i]);
    const double upper = std::max(ring.y[before], ring.y[i]);
    if (right >= own.left && left <= own.right && upper >= own.lower && lower <= own.upper) {
      const Bounds bounds{left, right, lower, upper};
      found.push_back({ring.node(before) + displacement, ring.node(i) + displacement,
                       bounds.moved(displacement)});
    }
  }
}

std::optional<Vector<2>> crossing(const CrossingSearch::Segment& a,
                                  const CrossingSearch::Segment& b) {
  const Vector<2> along = a.end - a.begin;
  const Vector<2> other = b.end - b.begin;
  const double scale = cross(along, other);
  if (scale == 0) return std::nullopt;
  const Vector<2> gap = b.begin - a.begin;
  const double s = cross(gap, other) / scale;
  const double t = cross(gap, along) / scale;
  if (s < 0 || s > 1 || t < 0 || t > 1) return std::nullopt;
  return Vector<2>(a.begin + s * along);
}

}  // namespace

bool contains(const RingView& ring, const Vector<2>& point) {
  bool inside = false;
  const std::size_t n = ring.nodes();
  for (std::size_t k = 0, before = n - 1; k < n; before = k++) {
    const double from = ring.y[before];
    const double to = ring.y[k];
    if ((from > point.y()) != (to > point.y())) {
      const double place =
          ring.x[before] + (point.y() - from) / (to - from) * (ring.x[k] - ring.x[before]);
      inside = inside != (point.x() < place);
    }
  }
  return inside;
}

std::optional<Vector<2>> CrossingSearch::operator()(const RingView& one, const RingView& other,
                                                    const Vector<2>& displacement,
                                                    const Bounds& common) {
  select_segments(common, one, Vector<2>::Zero(), mine_);
  if (mine_.empty()) return std::nullopt;
  select_segments(common, other, displacement, theirs_);
  for (const Segment& a : mine_) {
    for (const Segment& b : theirs_) {
      const bool are_near = a.bounds.left <= b.bounds.right && b.bounds.left <= a.bounds.right &&
                            a.bounds.lower <= b.bounds.upper && b.bounds.lower <= a.bounds.upper;
      if (!are_near) continue;
      if (const auto place = crossing(a, b)) return place;
    }
  }
  return std::nullopt;
}

}  // namespace hemoscale::micro
