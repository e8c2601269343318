#include "micro/cells/ring_concavity.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "micro/cells/ring_shape.hpp"

namespace hemoscale::micro {

namespace {

constexpr int samples_per_segment = 8;

double cross(const Vector<2>& a, const Vector<2>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Numbers of the samples on the convex hull, in the order of the samples.
std::vector<std::size_t> hull_of(const std::vector<Vector<2>>& points) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&points](std::size_t a, std::size_t b) {
    return points[a].x() != points[b].x() ? points[a].x() < points[b].x()
                                          : points[a].y() < points[b].y();
  });
  std::vector<std::size_t> hull;
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t start = hull.size();
    for (auto it = begin; it != end; ++it) {
      while (hull.size() >= start + 2 && cross(points[hull.back()] - points[hull[hull.size() - 2]],
                                               points[*it] - points[hull.back()]) <= 0) {
        hull.pop_back();
      }
      hull.push_back(*it);
    }
    hull.pop_back();  // begins the other chain
  };
  add_chain(order.begin(), order.end());
  add_chain(order.rbegin(), order.rend());
  std::sort(hull.begin(), hull.end());
  return hull;
}

// Moves both ends of a chord until it touches the curve there: (r2 - r1) x r'(s) = 0 at s1 and s2,
// by Newton's method from samples next to the solution.
void touch(const RingCurve& curve, double& s1, double& s2) {
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Vector<2> chord = curve.position(s2) - curve.position(s1);
    const Vector<2> t1 = curve.derivative(s1);
    const Vector<2> t2 = curve.derivative(s2);
    Tensor<2> jacobian;
    jacobian << cross(chord, curve.second_derivative(s1)), cross(t2, t1), -cross(t1, t2),
        cross(chord, curve.second_derivative(s2));
    const Vector<2> residual(cross(chord, t1), cross(chord, t2));
    const Vector<2> step = jacobian.inverse() * residual;
    // A flat end has no definite point of contact; any near the samples will do.
    if (!step.allFinite() || step.cwiseAbs().maxCoeff() > 1) return;
    s1 -= step[0];
    s2 -= step[1];
    if (step.cwiseAbs().maxCoeff() < 1e-12) return;
  }
}

Concavity measure_between(const RingCurve& curve, double s1, double s2) {
  Concavity result;
  result.first = curve.position(s1);
  result.second = curve.position(s2);
  const Vector<2> chord = (result.second - result.first).normalized();
  result.outward = {chord.y(), -chord.x()};
  const auto depth_at = [&](double s) {
    return (result.first - curve.position(s)).dot(result.outward);
  };
  const int count = samples_per_segment * static_cast<int>(std::ceil(s2 - s1));
  const double spacing = (s2 - s1) / count;
  double deepest = s1;
  for (int k = 1; k < count; ++k) {
    if (depth_at(s1 + k * spacing) > depth_at(deepest)) deepest = s1 + k * spacing;
  }
  // Golden section: the depth has one maximum between the neighbours of the deepest sample.
  double low = deepest - spacing;
  double high = deepest + spacing;
  const double ratio = std::numbers::phi - 1;
  while (high - low > 1e-7 * spacing) {
    const double a = high - ratio * (high - low);
    const double b = low + ratio * (high - low);
    (depth_at(a) > depth_at(b) ? high : low) = depth_at(a) > depth_at(b) ? b : a;
  }
  deepest = (low + high) / 2;
  result.deepest = curve.position(deepest);
  result.depth = depth_at(deepest);
  // Simpson's rule over r x dr: error of fourth order in a spacing of an eighth of the nodes'.
  double sectors = 0;
  const auto sector = [&](double s) {
    return cross(curve.position(s) - result.first, curve.derivative(s));
  };
  for (int k = 0; k < count; ++k) {
    const double s = s1 + k * spacing;
    sectors += spacing / 6 * (sector(s) + 4 * sector(s + spacing / 2) + sector(s + spacing));
  }
  result.area = -sectors / 2;
  return result;
}

}  // namespace

std::vector<Concavity> concavities(const RingCurve& curve) {
  const double fraction = 1.0 / samples_per_segment;
  std::vector<Vector<2>> samples;
  samples.reserve(curve.segments() * samples_per_segment);
  for (std::size_t i = 0; i < curve.segments(); ++i) {
    for (int k = 0; k < samples_per_segment; ++k) {
      samples.push_back(value(curve.segment(i), k * fraction));
    }
  }
  const std::vector<std::size_t> hull = hull_of(samples);
  const Reach along = reach_along(curve, Vector<2>::UnitX());
  const double visible = 1e-6 * (along.largest - along.smallest);
  std::vector<Concavity> found;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const std::size_t first = hull[k];
    const std::size_t second = k + 1 < hull.size() ? hull[k + 1] : hull[0] + samples.size();
    if (second == first + 1) continue;
    double s1 = fraction * static_cast<double>(first);
    double s2 = fraction * static_cast<double>(second);
    touch(curve, s1, s2);
    if (s2 <= s1) continue;  // both ends have run together: no concavity but a flat place
    const Concavity concavity = measure_between(curve, s1, s2);
    if (concavity.depth > visible) found.push_back(concavity);
  }
  return found;
}

double dimple_depth(std::span<const Concavity> concavities, const Vector<2>& direction) {
  double deepest = 0;
  for (const Concavity& concavity : concavities) {
    const double facing = concavity.outward.dot(direction);
    if (facing >= std::numbers::sqrt2 / 2) deepest = std::max(deepest, concavity.depth / facing);
  }
  return deepest;
}

double convexity(double area, std::span<const Concavity> concavities) {
  double hull = area;
  for (const Concavity& concavity : concavities) hull += concavity.area;
  return area / hull;
}

}  // namespace hemoscale::micro
