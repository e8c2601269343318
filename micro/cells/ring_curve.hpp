#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Smooth closed curve through the nodes of a ring: the periodic cubic spline r(s) whose parameter
/// counts nodes, r(i) = X_i, r(s + n) = r(s).
///
/// Where the spacing of the nodes varies smoothly along the ring, positions between them are
/// accurate to fourth order in the spacing, tangents to third and curvatures to second; extents,
/// areas and moments of the curve are of fourth order, those of the polygon of second. A kink is
/// felt over some four nodes on each side and no further.
class RingCurve {
 public:
  /// On segment i, with t = s - i in [0, 1]: r = c0 + c1 t + c2 t^2 + c3 t^3.
  using Cubic = std::array<Vector<2>, 4>;  // [m]

  /// @param nodes  [m] in order along the ring; or one velocity for each node [m/s], for the
  ///               velocity between them
  /// @throws ParameterError for fewer than four nodes, or values that are not finite
  explicit RingCurve(std::span<const Vector<2>> nodes);

  std::size_t segments() const { return segments_.size(); }
  const Cubic& segment(std::size_t i) const { return segments_[i]; }

  Vector<2> position(double s) const;
  Vector<2> derivative(double s) const;         // dr/ds, per node
  Vector<2> second_derivative(double s) const;  // d2r/ds2, per node^2

  /// The curve displaced by a vector.
  RingCurve moved(const Vector<2>& displacement) const;

 private:
  std::vector<Cubic> segments_;
};

inline Vector<2> value(const RingCurve::Cubic& c, double t) {
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

inline Vector<2> slope(const RingCurve::Cubic& c, double t) {
  return c[1] + t * (2 * c[2] + t * 3 * c[3]);
}

/// Gauss-Legendre points and weights on [0, 1]. Polynomials up to degree 11 are integrated exactly:
/// all moments of area of a cubic curve up to the second.
struct GaussRule {
  static constexpr std::array<double, 6> points = {0.033765242898423986, 0.16939530676686776,
                                                   0.38069040695840156,  0.61930959304159844,
                                                   0.83060469323313224,  0.96623475710157601};
  static constexpr std::array<double, 6> weights = {0.085662246189585178, 0.18038078652406930,
                                                    0.23395696728634552,  0.23395696728634552,
                                                    0.18038078652406930,  0.085662246189585178};
};

/// Calls visit(weight, r, dr/ds) at the Gauss points of every segment, in order.
template <typename Visit>
void for_each_point(const RingCurve& curve, const Visit& visit) {
  for (std::size_t i = 0; i < curve.segments(); ++i) {
    for (std::size_t k = 0; k < GaussRule::points.size(); ++k) {
      const double t = GaussRule::points[k];
      visit(GaussRule::weights[k], value(curve.segment(i), t), slope(curve.segment(i), t));
    }
  }
}

}  // namespace hemoscale::micro
