#include "micro/immersed/cell_stress.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "micro/immersed/flat_points.hpp"
#include "tests/support/immersed/implicit_runs.hpp"

namespace hemoscale::micro {
namespace {

using std::numbers::pi;
using Points = std::vector<Vector<2>>;

constexpr double viscosity = 1.3;

// A circular drop that capillary forces keep circular in the shear u = y. Its forces are
// q sin(2 phi) e_r, with the q that lets nothing cross it. [eta] = (1 + 2 lambda)/(1 + lambda): one
// for a bubble, two for a rigid disc.
TEST(CellStress, of_a_circular_drop_is_exact) {
  const double radius = 0.7;
  const int nodes = 40;
  const RingQuadrature quadrature(static_cast<std::size_t>(nodes));
  const RingContour ring = quadrature.contour(test::circle(radius, nodes));
  const Eigen::MatrixXd single = single_layer(quadrature, ring, PlaneKernel{}, viscosity);
  const Eigen::MatrixXd twice = double_layer(quadrature, ring, PlaneKernel{});
  for (const double ratio : {1e-6, 0.3, 1.0, 5.0, 1e6}) {
    Eigen::MatrixXd m = -(1 - ratio) * twice;
    m.diagonal().array() += 0.5 * (1 + ratio);
    Points shear, unit;
    for (int i = 0; i < nodes; ++i) {
      const auto k = static_cast<std::size_t>(i);
      shear.emplace_back(ring.positions[k].y(), 0);
      unit.emplace_back(std::sin(4 * pi * i / nodes) * ring.lengths[k] * ring.normals[k]);
    }
    const Eigen::PartialPivLU<Eigen::MatrixXd> solver(m);
    const Eigen::VectorXd by_shear = solver.solve(flat_of(shear));
    const Eigen::VectorXd by_force = solver.solve(single * flat_of(unit));
    const std::size_t at = 5;  // phi = pi/4: sin(2 phi) is one
    const double q = -ring.normals[at].dot(points_of(by_shear)[at]) /
                     ring.normals[at].dot(points_of(by_force)[at]);
    const Points velocities = points_of(by_shear + q * by_force);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      EXPECT_NEAR(velocities[i].dot(ring.normals[i]), 0, 1e-9);
    }
    const RingSource drop(quadrature, ring, points_of(q * flat_of(unit)), velocities, ratio);
    const Tensor<2> stress = cell_stress(drop, viscosity);
    const double area = pi * radius * radius;
    EXPECT_NEAR(stress(0, 1) / (viscosity * area), (1 + 2 * ratio) / (1 + ratio), 1e-6) << ratio;
    EXPECT_NEAR(stress(1, 0), stress(0, 1), 1e-9);
    EXPECT_NEAR(stress(0, 0) - stress(1, 1), 0, 1e-9);
  }
}

// A circle that neither bends nor stretches is a rigid disc, whatever is inside.
TEST(CellStress, of_a_rigid_disc_is_two) {
  const double rate = 100;
  const double radius = 3 * test::micron;
  for (const double ratio : {1.0, 5.0}) {
    ImplicitMembranes membranes(
        test::shear(rate),
        {test::cell_of(test::circle(radius, 40),
                       {.stretch_modulus = 1, .bending_modulus = 1e-12, .viscosity_ratio = ratio})},
        {.longest_step = 1e-4, .step_tolerance = 0});
    membranes.advance_by(4e-4);
    const Tensor<2> stress = cell_stress(membranes.sources()[0], test::water.viscosity());
    const double scale = test::water.viscosity() * rate * pi * radius * radius;
    EXPECT_NEAR(stress(0, 1) / scale, 2, 1e-3) << ratio;
    EXPECT_NEAR(stress(1, 0) / scale, 2, 1e-3) << ratio;
    EXPECT_NEAR((stress(0, 0) - stress(1, 1)) / scale, 0, 1e-3) << ratio;
    EXPECT_NEAR(test::look_at(membranes).motion.rigid_rate, -rate / 2, 1e-3 * rate) << ratio;
  }
}

}  // namespace
}  // namespace hemoscale::micro
