#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "micro/cells/area.hpp"
#include "micro/cells/half_angle_bending.hpp"
#include "micro/cells/outline.hpp"
#include "micro/cells/stretch.hpp"
#include "micro/cells/turning_angle_bending.hpp"
#include "tests/support/micro/rings.hpp"

// Energies of the node laws against the continuum, on an ellipse with half axes a and b.
namespace hemoscale::micro {
namespace {

constexpr double a = 4e-6;
constexpr double b = 1.6e-6;

/// Integral over the parameter angle by the trapezoidal rule, which is exact to round-off here.
double around(const std::function<double(double)>& f) {
  constexpr int n = 2000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    sum += f(2 * std::numbers::pi * i / n);
  }
  return sum * 2 * std::numbers::pi / n;
}

double speed(double t) {
  return std::hypot(a * std::sin(t), b * std::cos(t));
}
double curvature(double t) {
  return a * b / std::pow(speed(t), 3);
}

test::Polygon ellipse(int nodes) {
  return outline_nodes({.outline = Outline::ellipse, .length = 2 * a, .aspect = b / a}, nodes);
}

/// Observed order between 80 and 320 nodes.
template <class Energy>
double order(const Energy& energy, double exact) {
  const double coarse = std::abs(energy(80) / exact - 1);
  const double fine = std::abs(energy(320) / exact - 1);
  EXPECT_LT(fine, 5e-3);
  return std::log(coarse / fine) / std::log(4.0);
}

template <class Law>
double flat_bending(int nodes) {
  const test::Polygon polygon = ellipse(nodes);
  return test::ring_energy_of(Law{1.0}, make_ring_mesh(polygon, NaturalShape::flat), polygon);
}

TEST(MembraneConvergence, both_bending_laws_converge_with_second_order) {
  const double exact = 0.5 * around([](double t) { return std::pow(curvature(t), 2) * speed(t); });
  EXPECT_NEAR(order(flat_bending<TurningAngleBending>, exact), 2, 0.1);
  EXPECT_NEAR(order(flat_bending<HalfAngleBending>, exact), 2, 0.1);
}

TEST(MembraneConvergence, stretching_converges_with_second_order) {
  // A circle of radius a squeezed to the ellipse: strain = speed(t) / a - 1.
  const double exact = 0.5 * around([](double t) { return std::pow(speed(t) / a - 1, 2) * a; });
  const auto energy = [](int nodes) {
    const test::Polygon circle = test::regular_polygon(nodes, a);
    test::Polygon squeezed = circle;
    for (auto& node : squeezed) {
      node.y() *= b / a;
    }
    return test::ring_energy_of(Stretch{1.0}, make_ring_mesh(circle, NaturalShape::flat), squeezed);
  };
  EXPECT_NEAR(order(energy, exact), 2, 0.1);
}

TEST(MembraneConvergence, area_penalty_converges_with_second_order) {
  const double rest = std::numbers::pi * 2e-6 * 2e-6;
  const double exact = 0.5 * std::pow(std::numbers::pi * a * b - rest, 2) / rest;
  const auto energy = [&](int nodes) {
    RingMesh mesh = make_ring_mesh(ellipse(nodes), NaturalShape::flat);
    mesh.rest_area = rest;
    return test::ring_energy_of(AreaPenalty{1.0}, mesh, ellipse(nodes));
  };
  EXPECT_NEAR(order(energy, exact), 2, 0.1);
}

}  // namespace
}  // namespace hemoscale::micro
