#include "micro/cells/ring_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "micro/cells/ring_shape.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {

namespace {

double cross(const Vector<2>& a, const Vector<2>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Calls visit(weight, r, dr/ds, u) at the Gauss points of every segment.
template <typename Visit>
void for_each_point(const RingCurve& curve, const RingCurve& velocities, const Visit& visit) {
  for (std::size_t i = 0; i < curve.segments(); ++i) {
    for (std::size_t k = 0; k < GaussRule::points.size(); ++k) {
      const double t = GaussRule::points[k];
      visit(GaussRule::weights[k], value(curve.segment(i), t), slope(curve.segment(i), t),
            value(velocities.segment(i), t));
    }
  }
}

// Rate of the area moments with the moving outline: the flux of X_i X_j through it, n ds being
// (dy, -dx). The motion of the centroid does not change them to first order.
Tensor<2> moment_rates(const RingCurve& curve, const RingCurve& velocities,
                       const Vector<2>& centroid) {
  Tensor<2> rates = Tensor<2>::Zero();
  for_each_point(
      curve, velocities,
      [&](double weight, const Vector<2>& r, const Vector<2>& slope, const Vector<2>& u) {
        const Vector<2> x = r - centroid;
        rates += (weight * cross(u, slope)) * (x * x.transpose());
      });
  return rates;
}

// d/dt of (1/2) atan2(2 M_xy, M_xx - M_yy).
double axis_rate(const Tensor<2>& moments, const Tensor<2>& rates) {
  const double difference = moments(0, 0) - moments(1, 1);
  const double product = moments(0, 1);
  const double square = difference * difference + 4 * product * product;
  if (square <= 1e-20 * moments.squaredNorm()) return std::numeric_limits<double>::quiet_NaN();
  return (difference * rates(0, 1) - product * (rates(0, 0) - rates(1, 1))) / square;
}

void subtract_rigid_motion(const RingCurve& curve, const RingCurve& velocities, double perimeter,
                           RingMotion& motion) {
  Vector<2> middle = Vector<2>::Zero();
  Vector<2> mean = Vector<2>::Zero();
  for_each_point(
      curve, velocities,
      [&](double weight, const Vector<2>& r, const Vector<2>& slope, const Vector<2>& u) {
        const double share = weight * slope.norm() / perimeter;
        middle += share * r;
        mean += share * u;
      });
  double spin = 0;
  double inertia = 0;
  for_each_point(
      curve, velocities,
      [&](double weight, const Vector<2>& r, const Vector<2>& slope, const Vector<2>& u) {
        const double share = weight * slope.norm() / perimeter;
        spin += share * cross(r - middle, u - mean);
        inertia += share * (r - middle).squaredNorm();
      });
  motion.rigid_rate = spin / inertia;
  const auto relative = [&](const Vector<2>& r, const Vector<2>& u) {
    const Vector<2> arm = r - middle;
    return Vector<2>(u - mean - motion.rigid_rate * Vector<2>(-arm.y(), arm.x()));
  };
  double square = 0;
  for_each_point(
      curve, velocities,
      [&](double weight, const Vector<2>& r, const Vector<2>& slope, const Vector<2>& u) {
        square += weight * slope.norm() / perimeter * relative(r, u).squaredNorm();
      });
  motion.relative_speed = std::sqrt(square);
  for (std::size_t i = 0; i < curve.segments(); ++i) {
    motion.largest_relative = std::max(
        motion.largest_relative, relative(curve.segment(i)[0], velocities.segment(i)[0]).norm());
  }
}

}  // namespace

RingMotion measure_motion(const RingCurve& curve, const RingCurve& velocities) {
  if (curve.segments() != velocities.segments()) {
    throw ParameterError(fmt::format("{} velocities for a ring of {} nodes; give one for each node",
                                     velocities.segments(), curve.segments()));
  }
  const RingShape shape = measure_shape(curve);
  RingMotion motion;
  // Rate of int X dA, with X from the centroid: the rate of the area itself then drops out.
  for_each_point(
      curve, velocities,
      [&](double weight, const Vector<2>& r, const Vector<2>& slope, const Vector<2>& u) {
        motion.velocity += weight * cross(u, slope) / shape.area * (r - shape.centroid);
      });
  for_each_point(curve, velocities,
                 [&](double weight, const Vector<2>&, const Vector<2>& slope, const Vector<2>& u) {
                   motion.tangential_speed +=
                       weight * (u - motion.velocity).dot(slope) / shape.perimeter;
                 });
  motion.treading_rate = 2 * std::numbers::pi * motion.tangential_speed / shape.perimeter;
  motion.inclination_rate = axis_rate(area_moments(curve, shape.centroid),
                                      moment_rates(curve, velocities, shape.centroid));
  subtract_rigid_motion(curve, velocities, shape.perimeter, motion);
  return motion;
}

}  // namespace hemoscale::micro
