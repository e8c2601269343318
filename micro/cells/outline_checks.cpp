#include "micro/cells/outline_checks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

using Ring = std::span<const Vector<2>>;

double cross(const Vector<2>& a, const Vector<2>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Smallest box along the axes.
struct Bounds {
  explicit Bounds(Ring points) : low(points[0]), high(points[0]) {
    for (const auto& point : points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  }
  double distance(const Bounds& other) const {
    const Vector<2> gap = (other.low - high).cwiseMax(low - other.high).cwiseMax(Vector<2>::Zero());
    return gap.norm();
  }
  Vector<2> low, high;
};

/// The point of the segment from a to b nearest to p.
Vector<2> nearest(const Vector<2>& a, const Vector<2>& b, const Vector<2>& p) {
  const Vector<2> along = b - a;
  const double square = along.squaredNorm();
  const double part = square > 0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0;
  return a + part * along;
}

bool within(const Vector<2>& a, const Vector<2>& b, const Vector<2>& p) {
  return p.x() >= std::min(a.x(), b.x()) && p.x() <= std::max(a.x(), b.x()) &&
         p.y() >= std::min(a.y(), b.y()) && p.y() <= std::max(a.y(), b.y());
}

/// A common point of the closed segments ab and cd. An end that lies exactly on the other segment
/// counts.
std::optional<Vector<2>> common_point(const Vector<2>& a, const Vector<2>& b, const Vector<2>& c,
                                      const Vector<2>& d) {
  const double side_a = cross(d - c, a - c);
  const double side_b = cross(d - c, b - c);
  const double side_c = cross(b - a, c - a);
  const double side_d = cross(b - a, d - a);
  if (((side_a > 0 && side_b < 0) || (side_a < 0 && side_b > 0)) &&
      ((side_c > 0 && side_d < 0) || (side_c < 0 && side_d > 0))) {
    return (a + side_a / (side_a - side_b) * (b - a)).eval();
  }
  if (side_a == 0 && within(c, d, a)) return a;
  if (side_b == 0 && within(c, d, b)) return b;
  if (side_c == 0 && within(a, b, c)) return c;
  if (side_d == 0 && within(a, b, d)) return d;
  return std::nullopt;
}

/// Node i of `nodes` against all segments of `other`; keeps the closest in `best`.
void approach(const Chain& nodes, const Chain& other, bool of_first, Approach& best) {
  for (std::size_t i = 0; i < nodes.nodes.size(); ++i) {
    for (std::size_t j = 0; j < other.segments(); ++j) {
      const Vector<2>& node = nodes.nodes[i];
      const double distance = (nearest(other.nodes[j], other.end(j), node) - node).norm();
      if (distance < best.distance) {
        best = {distance, of_first, i, j, node};
      }
    }
  }
}

std::string place(const Vector<2>& p) {
  return fmt::format("({:.4g}, {:.4g}) m", p.x(), p.y());
}

std::vector<std::string> single_faults(std::span<const std::vector<Vector<2>>> rings) {
  std::vector<std::string> faults;
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const Ring ring = rings[k];
    if (ring.size() < 3) {
      faults.push_back(fmt::format("cell {} has {} nodes; at least 3 enclose an area; add nodes", k,
                                   ring.size()));
    } else if (const auto node = coincident_neighbours(ring)) {
      faults.push_back(
          fmt::format("cell {}: node {} at {} is not finite or lies where the next one is; nodes "
                      "must be apart; "
                      "space them evenly",
                      k, *node, place(ring[*node])));
    } else if (const auto meeting = self_crossing(ring)) {
      faults.push_back(fmt::format(
          "cell {} crosses itself: segments {} and {} (from the nodes of these numbers) "
          "meet at {}; the outline must be simple; choose a larger reduced area or "
          "correct the nodes",
          k, meeting->first, meeting->second, place(meeting->place)));
    } else if (!(enclosed_area(ring) > 0)) {
      faults.push_back(
          fmt::format("cell {} encloses {} m^2; it must be positive; number the nodes "
                      "counter-clockwise",
                      k, enclosed_area(ring)));
    }
  }
  return faults;
}

}  // namespace

double enclosed_area(Ring ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    sum += cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
  }
  return 0.5 * sum;
}

std::optional<std::size_t> coincident_neighbours(Ring ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (!((ring[(i + 1) % ring.size()] - ring[i]).squaredNorm() > 0) || !ring[i].allFinite()) {
      return i;
    }
  }
  return std::nullopt;
}

std::optional<Meeting> self_crossing(Ring ring) {
  const Chain chain{ring};
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    // Neighbours share a node by nature. Where they fold back onto each other, the segment after
    // them starts on the first.
    for (std::size_t j = i + 2; j < n && (i > 0 || j + 1 < n); ++j) {
      if (const auto point = common_point(ring[i], chain.end(i), ring[j], chain.end(j))) {
        return Meeting{i, j, *point};
      }
    }
  }
  return std::nullopt;
}

std::optional<Meeting> crossing(const Chain& first, const Chain& second) {
  const Bounds around(second.nodes);
  if (Bounds(first.nodes).distance(around) > 0) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < first.segments(); ++i) {
    const Vector<2>& a = first.nodes[i];
    const Vector<2>& b = first.end(i);
    if ((a.cwiseMin(b) - around.high).maxCoeff() > 0 ||
        (around.low - a.cwiseMax(b)).maxCoeff() > 0) {
      continue;
    }
    for (std::size_t j = 0; j < second.segments(); ++j) {
      if (const auto point = common_point(a, b, second.nodes[j], second.end(j))) {
        return Meeting{i, j, *point};
      }
    }
  }
  return std::nullopt;
}

bool encloses(Ring ring, const Vector<2>& point) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector<2>& a = ring[i];
    const Vector<2>& b = ring[(i + 1) % ring.size()];
    if ((a.y() > point.y()) != (b.y() > point.y())) {
      const double side = cross(b - a, point - a);
      inside = inside != ((b.y() > a.y()) == (side > 0));
    }
  }
  return inside;
}

std::optional<Approach> closest(const Chain& first, const Chain& second, double reach) {
  if (Bounds(first.nodes).distance(Bounds(second.nodes)) > reach) {
    return std::nullopt;
  }
  Approach best;
  best.distance = std::numeric_limits<double>::infinity();
  approach(first, second, true, best);
  approach(second, first, false, best);
  return best.distance <= reach ? std::optional(best) : std::nullopt;
}

std::optional<Approach> closest_across(Ring ring) {
  const Chain chain{ring};
  const std::size_t n = ring.size();
  std::vector<double> way(n + 1, 0.0);  // along the outline to node i
  for (std::size_t i = 0; i < n; ++i) {
    way[i + 1] = way[i] + (chain.end(i) - ring[i]).norm();
  }
  Approach best;
  best.distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const Vector<2> foot = nearest(ring[j], chain.end(j), ring[i]);
      const double distance = (foot - ring[i]).norm();
      if (distance < best.distance) {
        const double onward = std::abs(way[j] + (foot - ring[j]).norm() - way[i]);
        const double apart = std::min(onward, way[n] - onward);
        if (apart > 2 * distance && apart > way[n] / static_cast<double>(n)) {
          best = {distance, true, i, j, ring[i]};
        }
      }
    }
  }
  return std::isfinite(best.distance) ? std::optional(best) : std::nullopt;
}

std::vector<std::string> outline_faults(std::span<const std::vector<Vector<2>>> rings,
                                        std::span<const Chain> walls) {
  std::vector<std::string> faults = single_faults(rings);
  if (!faults.empty()) {
    return faults;  // what follows needs proper rings
  }
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const Chain ring{rings[k]};
    for (std::size_t m = k + 1; m < rings.size(); ++m) {
      if (const auto meeting = crossing(ring, Chain{rings[m]})) {
        faults.push_back(
            fmt::format("cells {} and {} overlap: segment {} of the first meets segment {} of the "
                        "second at {}; cells must be apart; move one of them",
                        k, m, meeting->first, meeting->second, place(meeting->place)));
      } else if (encloses(rings[k], rings[m][0]) || encloses(rings[m], rings[k][0])) {
        faults.push_back(
            fmt::format("of cells {} and {} one lies inside the other, at {}; cells must be apart; "
                        "move one of them",
                        k, m, place(rings[m][0])));
      }
    }
    for (std::size_t w = 0; w < walls.size(); ++w) {
      if (const auto meeting = crossing(ring, walls[w])) {
        faults.push_back(fmt::format(
            "cell {} touches wall {}: segment {} of the cell meets piece {} of the wall "
            "at {}; cells must keep off walls; move the cell or make it smaller",
            k, w, meeting->first, meeting->second, place(meeting->place)));
      }
    }
  }
  return faults;
}

void require_separate(std::span<const std::vector<Vector<2>>> rings, std::span<const Chain> walls) {
  const std::vector<std::string> faults = outline_faults(rings, walls);
  if (!faults.empty()) {
    std::string text = "cells:";
    for (const auto& line : faults) {
      text += "\n" + line;
    }
    throw ParameterError(text);
  }
}

}  // namespace hemoscale::micro
