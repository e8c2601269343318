#include "micro/cells/ring_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "micro/error.hpp"

namespace hemoscale::micro {

namespace {

constexpr double pi = std::numbers::pi;

double cross(const Vector<2>& a, const Vector<2>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

Reach reach_along(const RingCurve& curve, const Vector<2>& direction) {
  Reach reach{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const auto look_at = [&reach](double height) {
    reach.smallest = std::min(reach.smallest, height);
    reach.largest = std::max(reach.largest, height);
  };
  for (std::size_t i = 0; i < curve.segments(); ++i) {
    const RingCurve::Cubic& c = curve.segment(i);
    look_at(c[0].dot(direction));
    // Turning points inside the segment: roots of k0 + 2 k1 t + k2 t^2, in the form that does not
    // cancel.
    const double k0 = c[1].dot(direction);
    const double k1 = c[2].dot(direction);
    const double k2 = 3 * c[3].dot(direction);
    const double discriminant = k1 * k1 - k0 * k2;
    if (discriminant < 0) continue;
    const double q = -(k1 + std::copysign(std::sqrt(discriminant), k1));
    for (const double t : {q / k2, k0 / q}) {
      // A quotient that is not finite belongs to a root at infinity, and fails the comparison.
      if (t > 0 && t < 1) look_at(value(c, t).dot(direction));
    }
  }
  return reach;
}

Tensor<2> area_moments(const RingCurve& curve, const Vector<2>& centroid) {
  // Green: int F dA = (1/4) closed int X_i X_j (X x dX), as the integrand is homogeneous of degree
  // two.
  Tensor<2> moments = Tensor<2>::Zero();
  for_each_point(curve, [&](double weight, const Vector<2>& r, const Vector<2>& slope) {
    const Vector<2> x = r - centroid;
    moments += (0.25 * weight * cross(x, slope)) * (x * x.transpose());
  });
  return moments;
}

RingShape measure_shape(const RingCurve& curve) {
  RingShape shape;
  // About a point on the curve: coordinates of a cell far from the origin would cancel.
  const Vector<2> origin = curve.segment(0)[0];
  Vector<2> first_moment = Vector<2>::Zero();
  for_each_point(curve, [&](double weight, const Vector<2>& r, const Vector<2>& slope) {
    const Vector<2> x = r - origin;
    const double sector = weight * cross(x, slope);
    shape.area += sector / 2;
    first_moment += sector / 3 * x;
    shape.perimeter += weight * slope.norm();
  });
  if (!(std::abs(shape.area) > 0)) {
    throw ParameterError(fmt::format("a ring of {} nodes encloses the area {} m^2, not positive",
                                     curve.segments(), shape.area));
  }
  shape.reduced_area = 4 * pi * shape.area / (shape.perimeter * shape.perimeter);
  shape.centroid = origin + first_moment / shape.area;
  const Reach along = reach_along(curve, Vector<2>::UnitX());
  const Reach across = reach_along(curve, Vector<2>::UnitY());
  shape.lower = {along.smallest, across.smallest};
  shape.upper = {along.largest, across.largest};
  shape.length = along.largest - along.smallest;
  shape.width = across.largest - across.smallest;

  const Tensor<2> moments = area_moments(curve, shape.centroid) / shape.area;
  const double mean = moments.trace() / 2;
  const double difference = (moments(0, 0) - moments(1, 1)) / 2;
  const double deviation = std::hypot(difference, moments(0, 1));
  shape.inclination = 0.5 * std::atan2(moments(0, 1), difference);
  const double longer = std::sqrt(mean + deviation);
  const double shorter = std::sqrt(mean - deviation);
  shape.deformation = (longer - shorter) / (longer + shorter);
  const Vector<2> axis(std::cos(shape.inclination), std::sin(shape.inclination));
  const Reach by_axis = reach_along(curve, axis);
  const Reach by_normal = reach_along(curve, {-axis.y(), axis.x()});
  shape.axial_length = by_axis.largest - by_axis.smallest;
  shape.axial_width = by_normal.largest - by_normal.smallest;
  return shape;
}

}  // namespace hemoscale::micro
