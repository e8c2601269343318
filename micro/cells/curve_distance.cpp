#include "micro/cells/curve_distance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "micro/cells/ring_shape.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {

namespace {

// A piece of a curve by its Bezier points. The curve stays within `bulge` of the chord, as its
// points do.
struct Piece {
  std::array<Vector<2>, 4> points;
  double bulge = 0;  // [m]
};

double cross(const Vector<2>& a, const Vector<2>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double distance(const Vector<2>& p, const Vector<2>& a, const Vector<2>& b) {
  const Vector<2> chord = b - a;
  const double square = chord.squaredNorm();
  if (square == 0) return (p - a).norm();
  const double along = std::clamp((p - a).dot(chord) / square, 0.0, 1.0);
  return (p - a - along * chord).norm();
}

double distance_between_chords(const Piece& p, const Piece& q) {
  const Vector<2>& a = p.points[0];
  const Vector<2>& b = p.points[3];
  const Vector<2>& c = q.points[0];
  const Vector<2>& d = q.points[3];
  if (cross(b - a, c - a) * cross(b - a, d - a) < 0 &&
      cross(d - c, a - c) * cross(d - c, b - c) < 0) {
    return 0;
  }
  return std::min({distance(a, c, d), distance(b, c, d), distance(c, a, b), distance(d, a, b)});
}

Piece piece_of(const std::array<Vector<2>, 4>& points) {
  return {points, std::max(distance(points[1], points[0], points[3]),
                           distance(points[2], points[0], points[3]))};
}

std::vector<Piece> pieces_of(const RingCurve& curve) {
  std::vector<Piece> pieces;
  pieces.reserve(curve.segments());
  for (std::size_t i = 0; i < curve.segments(); ++i) {
    const RingCurve::Cubic& c = curve.segment(i);
    const Vector<2>& end = curve.segment((i + 1) % curve.segments())[0];
    pieces.push_back(piece_of({c[0], c[0] + c[1] / 3, c[0] + (2 * c[1] + c[2]) / 3, end}));
  }
  return pieces;
}

// Halves of a piece, by the construction of de Casteljau.
std::array<Piece, 2> halves(const Piece& piece) {
  const auto& [p0, p1, p2, p3] = piece.points;
  const Vector<2> p01 = (p0 + p1) / 2;
  const Vector<2> p12 = (p1 + p2) / 2;
  const Vector<2> p23 = (p2 + p3) / 2;
  const Vector<2> p012 = (p01 + p12) / 2;
  const Vector<2> p123 = (p12 + p23) / 2;
  const Vector<2> middle = (p012 + p123) / 2;
  return {piece_of({p0, p01, p012, middle}), piece_of({middle, p123, p23, p3})};
}

// Lowers `smallest` to the distance of two pieces, if that is smaller by more than the tolerance.
// Divides the more bent one until chords stand for the curves.
void approach(const Piece& p, const Piece& q, double tolerance, double& smallest) {
  const double chords = distance_between_chords(p, q);
  const double bulge = p.bulge + q.bulge;
  if (chords - bulge >= smallest - tolerance) return;
  if (bulge <= tolerance) {
    smallest = std::min(smallest, chords);
    return;
  }
  if (p.bulge >= q.bulge) {
    for (const Piece& half : halves(p)) approach(half, q, tolerance, smallest);
  } else {
    for (const Piece& half : halves(q)) approach(p, half, tolerance, smallest);
  }
}

double smallest_distance(const std::vector<Piece>& a, const std::vector<Piece>& b,
                         double tolerance) {
  double smallest = std::numeric_limits<double>::infinity();
  // Ends of pieces lie on the curves: a first bound, which rules out nearly all pairs.
  for (const Piece& p : a) {
    for (const Piece& q : b) {
      smallest = std::min(smallest, (p.points[0] - q.points[0]).norm());
    }
  }
  for (const Piece& p : a) {
    for (const Piece& q : b) approach(p, q, tolerance, smallest);
  }
  return smallest;
}

double tolerance_of(const RingCurve& curve) {
  const Reach along = reach_along(curve, Vector<2>::UnitX());
  const Reach across = reach_along(curve, Vector<2>::UnitY());
  return 1e-6 * std::max(along.largest - along.smallest, across.largest - across.smallest);
}

// Largest distance of points of one curve from the other.
double departure(const RingCurve& from, const RingCurve& to) {
  const std::vector<Piece> pieces = pieces_of(to);
  const double tolerance = tolerance_of(to);
  double largest = 0;
  for (std::size_t i = 0; i < from.segments(); ++i) {
    for (int k = 0; k < 8; ++k) {
      const Vector<2> point = value(from.segment(i), k / 8.0);
      const std::vector<Piece> alone = {piece_of({point, point, point, point})};
      largest = std::max(largest, smallest_distance(alone, pieces, tolerance));
    }
  }
  return largest;
}

}  // namespace

double gap(const RingCurve& cell, std::span<const Vector<2>> wall) {
  if (wall.size() < 2) {
    throw ParameterError(fmt::format("a wall of {} points; it needs at least 2", wall.size()));
  }
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < wall.size(); ++i) {
    pieces.push_back(piece_of({wall[i], wall[i], wall[i + 1], wall[i + 1]}));
  }
  return smallest_distance(pieces_of(cell), pieces, tolerance_of(cell));
}

double gap(const RingCurve& cell, const RingCurve& other) {
  return smallest_distance(pieces_of(cell), pieces_of(other), tolerance_of(cell));
}

double distance_to(const RingCurve& curve, const Vector<2>& point) {
  return smallest_distance({piece_of({point, point, point, point})}, pieces_of(curve),
                           tolerance_of(curve));
}

double largest_distance(const RingCurve& a, const RingCurve& b, Alignment alignment) {
  Vector<2> shift = Vector<2>::Zero();
  if (alignment != Alignment::none) {
    shift = measure_shape(a).centroid - measure_shape(b).centroid;
    if (alignment == Alignment::along_flow) shift.y() = 0;
  }
  const RingCurve moved = b.moved(shift);
  return std::max(departure(a, moved), departure(moved, a));
}

double asymmetry(const RingCurve& curve) {
  const double middle = measure_shape(curve).centroid.y();
  std::vector<Vector<2>> mirrored;
  for (std::size_t i = curve.segments(); i-- > 0;) {
    const Vector<2>& node = curve.segment(i)[0];
    mirrored.emplace_back(node.x(), 2 * middle - node.y());
  }
  // The image departs from the curve as far as the curve from the image.
  return departure(curve, RingCurve(mirrored));
}

}  // namespace hemoscale::micro
