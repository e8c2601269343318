#include "micro/cells/ring_curve.hpp"

#include <fmt/format.h>

#include <cmath>

#include "micro/error.hpp"

namespace hemoscale::micro {

namespace {

// Slopes of the spline, d_{i-1} + 4 d_i + d_{i+1} = 3 (X_{i+1} - X_{i-1}), on a ring. The operator
// on the left is that of two recursions, -(1/z) (1 - z E^-1)(1 - z E) with z = sqrt(3) - 2 and E
// the shift by one node; each is started with its periodic sum.
std::vector<Vector<2>> spline_slopes(std::span<const Vector<2>> nodes) {
  const std::size_t n = nodes.size();
  const double z = std::sqrt(3.0) - 2;
  const double closure = 1 / (1 - std::pow(z, static_cast<double>(n)));
  std::vector<Vector<2>> d(n);
  for (std::size_t i = 0; i < n; ++i) {
    d[i] = 3 * (nodes[(i + 1) % n] - nodes[(i + n - 1) % n]);
  }
  Vector<2> start = Vector<2>::Zero();
  for (std::size_t i = 1; i <= n; ++i) start = d[i % n] + z * start;
  d[0] = closure * start;
  for (std::size_t i = 1; i < n; ++i) d[i] += z * d[i - 1];
  start.setZero();
  for (std::size_t i = n; i-- > 0;) start = d[i] + z * start;
  d[0] = closure * start;
  for (std::size_t i = n - 1; i > 0; --i) d[i] += z * d[(i + 1) % n];
  for (Vector<2>& slope : d) slope *= -z;
  return d;
}

}  // namespace

RingCurve::RingCurve(std::span<const Vector<2>> nodes) {
  const std::size_t n = nodes.size();
  if (n < 4) {
    throw ParameterError(fmt::format("a curve through {} nodes; it needs at least 4", n));
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!nodes[i].allFinite()) {
      throw ParameterError(fmt::format("node {} of {} is at ({}, {}), which is not finite", i, n,
                                       nodes[i].x(), nodes[i].y()));
    }
  }
  const std::vector<Vector<2>> slopes = spline_slopes(nodes);
  segments_.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    const Vector<2> step = nodes[j] - nodes[i];
    segments_.push_back({nodes[i], slopes[i], 3 * step - 2 * slopes[i] - slopes[j],
                         slopes[i] + slopes[j] - 2 * step});
  }
}

namespace {

struct Place {
  std::size_t segment;
  double t;
};

Place place_of(double s, std::size_t segments) {
  const auto n = static_cast<double>(segments);
  const double inside = s - n * std::floor(s / n);
  const auto segment = static_cast<std::size_t>(inside);
  // Rounding of the line above can give n itself, which is the start of the ring.
  return segment < segments ? Place{segment, inside - static_cast<double>(segment)} : Place{0, 0};
}

}  // namespace

Vector<2> RingCurve::position(double s) const {
  const Place place = place_of(s, segments());
  return value(segments_[place.segment], place.t);
}

Vector<2> RingCurve::derivative(double s) const {
  const Place place = place_of(s, segments());
  return slope(segments_[place.segment], place.t);
}

Vector<2> RingCurve::second_derivative(double s) const {
  const Place place = place_of(s, segments());
  const Cubic& c = segments_[place.segment];
  return 2 * c[2] + 6 * place.t * c[3];
}

RingCurve RingCurve::moved(const Vector<2>& displacement) const {
  RingCurve result = *this;
  for (Cubic& c : result.segments_) c[0] += displacement;
  return result;
}

}  // namespace hemoscale::micro
