#include <gtest/gtest.h>

#include <cmath>

#include "micro/cells/ring_membrane.hpp"
#include "tests/support/micro/periodic_curve.hpp"
#include "tests/support/micro/rings.hpp"

// Every law against its continuum energy where nothing is simple: a lobed reference shape without
// symmetry, deformed to another by stretching that varies along the membrane. Per unit depth, with
// s0 the reference arc length, lambda the stretch and c the curvature:
//
//   stretch  (E_l/2) int (lambda - 1)^2 ds0
//   bending  (kappa/2) int (lambda c - c0)^2 ds0      what angles between elements converge to
//   area     (k_A/2) (A - A0)^2 / A0
namespace hemoscale::micro {
namespace {

constexpr double radius = 3e-6;

// Radius over angle of a reference shape and of a deformed one, both concave in places.
std::vector<Vector<2>> lobes(int points, double second, double third, double phase) {
  std::vector<Vector<2>> result;
  for (int i = 0; i < points; ++i) {
    const double t = 2 * std::numbers::pi * i / points;
    const double r = radius * (1 + second * std::cos(2 * t) + third * std::cos(3 * t + phase));
    result.emplace_back(r * std::cos(t), r * std::sin(t));
  }
  return result;
}

struct Shapes {
  test::PeriodicCurve reference{lobes(32, 0.3, 0.05, 0)};
  test::PeriodicCurve deformed{lobes(32, 0.2, 0.15, 0.7)};

  double stretch(double t) const { return deformed.speed(t) / reference.speed(t); }

  /// Parameters at equal steps of the reference arc length.
  std::vector<double> equal_steps(int nodes) const {
    const double whole = test::over_period([&](double t) { return reference.speed(t); });
    std::vector<double> result;
    double t = 0;
    double length = 0;
    for (int i = 0; i < nodes; ++i) {
      result.push_back(t);
      const double wanted = whole * (i + 1) / nodes;
      // Newton's method; Simpson's rule on a step of a fine polygon of arcs.
      const double start = t;
      const double before = length;
      for (int k = 0; k < 6; ++k) {
        length = before + arc(start, t);
        t -= (length - wanted) / reference.speed(t);
      }
      length = wanted;
    }
    return result;
  }

  test::Polygon nodes_on(const test::PeriodicCurve& curve, int nodes) const {
    test::Polygon polygon;
    for (const double t : equal_steps(nodes)) {
      polygon.emplace_back(curve.at(t).real(), curve.at(t).imag());
    }
    return polygon;
  }

 private:
  double arc(double from, double to) const {
    constexpr int pieces = 8;
    const double h = (to - from) / pieces;
    double sum = 0;
    for (int i = 0; i < pieces; ++i) {
      const double a = from + i * h;
      sum +=
          h / 6 * (reference.speed(a) + 4 * reference.speed(a + 0.5 * h) + reference.speed(a + h));
    }
    return sum;
  }
};

MembraneParameters parameters_of(StretchLaw stretch, BendingLaw bending, NaturalShape natural,
                                 double curvature) {
  return {.stretch_law = stretch,
          .stretch_modulus = 3e-6,
          .bending_modulus = 2e-19,
          .bending_law = bending,
          .natural_shape = natural,
          .spontaneous_curvature = curvature,
          .area_modulus = 40};
}

MembraneEnergy node_energy(const Shapes& shapes, const MembraneParameters& p, int nodes) {
  const RingMesh mesh = make_ring_mesh(shapes.nodes_on(shapes.reference, nodes), p.natural_shape,
                                       p.spontaneous_curvature);
  return RingMembrane(mesh, p).energy(shapes.nodes_on(shapes.deformed, nodes));
}

void expect_second_order(const Shapes& shapes, const MembraneParameters& p, double exact,
                         double MembraneEnergy::*part) {
  const double coarse = std::abs(node_energy(shapes, p, 160).*part / exact - 1);
  const double fine = std::abs(node_energy(shapes, p, 320).*part / exact - 1);
  EXPECT_LT(fine, 3e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.05);
}

TEST(MembraneContinuum, both_stretching_laws_converge_with_second_order) {
  const Shapes shapes;
  const double exact = 0.5 * 3e-6 * test::over_period([&](double t) {
                         return std::pow(shapes.stretch(t) - 1, 2) * shapes.reference.speed(t);
                       });
  for (const StretchLaw law : {StretchLaw::linear, StretchLaw::line_element}) {
    expect_second_order(shapes,
                        parameters_of(law, BendingLaw::turning_angle, NaturalShape::flat, 0), exact,
                        &MembraneEnergy::stretch);
  }
}

TEST(MembraneContinuum, both_bending_laws_converge_with_second_order_for_any_natural_shape) {
  const Shapes shapes;
  for (const NaturalShape natural :
       {NaturalShape::flat, NaturalShape::outline, NaturalShape::curvature}) {
    const double curvature = natural == NaturalShape::curvature ? -0.5 / radius : 0;
    const double exact =
        0.5 * 2e-19 * test::over_period([&](double t) {
          const double own =
              natural == NaturalShape::outline ? shapes.reference.curvature(t) : curvature;
          return std::pow(shapes.stretch(t) * shapes.deformed.curvature(t) - own, 2) *
                 shapes.reference.speed(t);
        });
    for (const BendingLaw law : {BendingLaw::turning_angle, BendingLaw::half_angle_tangent}) {
      expect_second_order(shapes, parameters_of(StretchLaw::linear, law, natural, curvature), exact,
                          &MembraneEnergy::bending);
    }
  }
}

TEST(MembraneContinuum, area_penalty_converges_with_second_order) {
  const Shapes shapes;
  const auto area = [](const test::PeriodicCurve& curve) {
    return 0.5 * test::over_period(
                     [&](double t) { return (std::conj(curve.at(t)) * curve.at(t, 1)).imag(); });
  };
  const double rest = area(shapes.reference);
  const double exact = 0.5 * 40 * std::pow(area(shapes.deformed) - rest, 2) / rest;
  expect_second_order(
      shapes, parameters_of(StretchLaw::linear, BendingLaw::turning_angle, NaturalShape::flat, 0),
      exact, &MembraneEnergy::area);
}

}  // namespace
}  // namespace hemoscale::micro
