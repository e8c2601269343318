// The distance from a circle drawn with n chords: the error is that of the chords, of second order.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "micro/ensemble/flow/wall_geometry.hpp"

namespace hemoscale::micro {
namespace {

double largest_error(int chords) {
  const double radius = 40e-6;  // [m]
  std::vector<Vector<2>> circle;
  for (int k = 0; k <= chords; ++k) {
    const double angle = 2 * std::acos(-1) * (k % chords) / chords;
    circle.push_back(radius * Vector<2>(std::cos(angle), std::sin(angle)));
  }
  const WallGeometry walls({circle}, 10e-6);
  double largest = 0;
  for (int k = 0; k < 3000; ++k) {
    const double angle = 0.1 + k * 2.399963;  // golden angle
    const double distance = 9e-6 * std::cos(0.37 * k);
    const double r = radius - distance;
    const Vector<2> direction(std::cos(angle), std::sin(angle));
    const WallDistance seen = walls.at(r * direction);
    largest = std::max(largest, std::abs(seen.distance - distance) / radius);
  }
  return largest;
}

TEST(WallOfACircle, is_approached_with_second_order) {
  const double coarse = largest_error(60);
  const double fine = largest_error(240);
  std::printf("error / radius: %.3e with 60 chords, %.3e with 240\n", coarse, fine);
  EXPECT_LE(coarse, 1.01 * (1 - std::cos(std::acos(-1) / 60)));
  EXPECT_NEAR(std::log2(coarse / fine) / 2, 2, 0.1);
}

}  // namespace
}  // namespace hemoscale::micro
