// The distance from walls against a search through every segment and the even-odd rule, for random
// polygons with corners of all angles.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "micro/ensemble/flow/wall_geometry.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::micro {
namespace {

using Polyline = std::vector<Vector<2>>;

class Draws {
 public:
  explicit Draws(std::uint64_t seed) : seed_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * uniform({seed_, 0, counter_++});
  }

 private:
  std::uint64_t seed_;
  std::uint64_t counter_ = 0;
};

/// A closed star: its corners jut in and out.
Polyline star(Draws& draws, const Vector<2>& centre, double size, int corners) {
  Polyline points;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::acos(-1) * (k + draws.between(0, 0.6)) / corners;
    const double radius = size * draws.between(0.3, 1);
    points.push_back(centre + radius * Vector<2>(std::cos(angle), std::sin(angle)));
  }
  points.push_back(points.front());
  return points;
}

double distance_from_segment(const Vector<2>& x, const Vector<2>& a, const Vector<2>& b) {
  const double t = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (x - a - t * (b - a)).norm();
}

/// Unsigned distance and whether x lies within an odd number of polylines.
std::pair<double, bool> by_brute_force(const std::vector<Polyline>& walls, const Vector<2>& x) {
  double least = std::numeric_limits<double>::infinity();
  bool is_inside = false;
  for (const Polyline& wall : walls) {
    for (std::size_t k = 0; k + 1 < wall.size(); ++k) {
      const Vector<2>& a = wall[k];
      const Vector<2>& b = wall[k + 1];
      least = std::min(least, distance_from_segment(x, a, b));
      if ((a[1] > x[1]) != (b[1] > x[1]) &&
          x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) {
        is_inside = !is_inside;
      }
    }
  }
  return {least, is_inside};
}

TEST(WallDistance, is_that_of_a_search_through_all_segments) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Draws draws(seed);
    // Fluid between an outer and an inner star; counter-clockwise it lies inside.
    Polyline inner = star(draws, {0.2, -0.1}, 2, 5 + static_cast<int>(seed));
    std::reverse(inner.begin(), inner.end());
    const std::vector<Polyline> walls = {star(draws, {0, 0}, 10, 11 * static_cast<int>(seed)),
                                         inner};
    // The inner star must lie within the outer one.
    if (by_brute_force({walls[0]}, {0.2, -0.1}).first < 2) continue;
    for (const double reach : {0.3, 2.0, 30.0}) {
      const WallGeometry geometry(walls, reach);
      for (int k = 0; k < 4000; ++k) {
        const Vector<2> x(draws.between(-14, 14), draws.between(-14, 14));
        const auto [distance, is_inside] = by_brute_force(walls, x);
        const WallDistance seen = geometry.at(x);
        ASSERT_EQ(seen.distance > 0, is_inside) << seed << " " << x.transpose();
        if (distance > reach) {
          ASSERT_GE(std::abs(seen.distance), reach);
          continue;
        }
        ASSERT_NEAR(std::abs(seen.distance), distance, 1e-12) << seed << " " << x.transpose();
        ASSERT_NEAR(seen.normal.norm(), 1, 1e-12);
      }
    }
  }
}

/// Towards the wall along the normal lies the wall itself.
TEST(WallDistance, has_its_gradient_as_the_normal) {
  Draws draws(5);
  const WallGeometry geometry({star(draws, {0, 0}, 10, 23)}, 30);
  int points = 0;
  for (int k = 0; k < 4000; ++k) {
    const Vector<2> x(draws.between(-14, 14), draws.between(-14, 14));
    const WallDistance seen = geometry.at(x);
    EXPECT_NEAR(geometry.at(x - seen.distance * seen.normal).distance, 0, 1e-12);
    const double step = 1e-6;
    Vector<2> gradient;
    for (const int axis : {0, 1}) {
      const Vector<2> d = step * Vector<2>::Unit(axis);
      gradient[axis] = (geometry.at(x + d).distance - geometry.at(x - d).distance) / (2 * step);
    }
    // Elsewhere two walls are equally near.
    if (std::abs(gradient.norm() - 1) > 1e-4) continue;
    ++points;
    EXPECT_NEAR((gradient - seen.normal).norm(), 0, 1e-4);
  }
  EXPECT_GT(points, 3900);
}

}  // namespace
}  // namespace hemoscale::micro
