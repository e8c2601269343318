#include "micro/cells/rest_shape.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "micro/cells/deflation_system.hpp"
#include "micro/cells/outline_checks.hpp"
#include "micro/cells/ring_membrane.hpp"
#include "micro/error.hpp"
#include "micro/random/philox.hpp"
#include "tests/support/micro/rings.hpp"

namespace hemoscale::micro {
namespace {

using testing::HasSubstr;

constexpr double pi = std::numbers::pi;
constexpr Deflation cell{.perimeter = 19e-6, .reduced_area = 0.46};

double area_of_circle(double perimeter, int nodes) {
  return perimeter * perimeter / (4 * nodes * std::tan(pi / nodes));
}

TEST(RestShape, keeps_every_length_and_has_the_wanted_area) {
  for (const int nodes : {8, 30, 59, 100}) {
    for (const double reduced_area : {0.999, 0.7, 0.46}) {
      Deflation d = cell;
      d.reduced_area = reduced_area;
      const RestShape shape = deflate(d, nodes);
      ASSERT_EQ(shape.nodes.size(), static_cast<std::size_t>(nodes));
      for (const double length : make_ring_mesh(shape.nodes, NaturalShape::flat).rest_length) {
        EXPECT_NEAR(length, d.perimeter / nodes, 1e-12 * d.perimeter);
      }
      EXPECT_NEAR(enclosed_area(shape.nodes), reduced_area * area_of_circle(d.perimeter, nodes),
                  1e-12 * d.perimeter * d.perimeter);
      EXPECT_FALSE(self_crossing(shape.nodes));
    }
  }
}

TEST(RestShape, lies_along_x_with_the_first_node_at_its_right_end) {
  const RestShape shape = deflate(cell, 59);
  const auto& nodes = shape.nodes;
  for (std::size_t i = 0; i < 59; ++i) {  // symmetric about x
    const Vector<2> image(nodes[(59 - i) % 59].x(), -nodes[(59 - i) % 59].y());
    EXPECT_LE((nodes[i] - image).norm(), 1e-12 * cell.perimeter);
    EXPECT_LE(nodes[i].x(), nodes[0].x());
    EXPECT_LT(std::abs(nodes[i].y()), 0.3 * nodes[0].x());
  }
}

TEST(RestShape, does_not_depend_on_the_disturbance_of_the_circle) {
  for (const double reduced_area : {0.9, 0.46, 0.3}) {
    Deflation d = cell;
    d.reduced_area = reduced_area;
    const auto first = deflate(d, 59).nodes;
    for (const std::uint64_t seed : {2U, 3U, 4U, 12345U}) {
      d.seed = seed;
      const auto other = deflate(d, 59).nodes;
      for (std::size_t i = 0; i < 59; ++i) {
        EXPECT_LE((first[i] - other[i]).norm(), 1e-11 * d.perimeter);
      }
    }
  }
}

// Without the directions of segments: the bending forces of the membrane must be balanced by
// tensions of the segments and one pressure, and displacements that keep lengths and area must
// raise the energy.
TEST(RestShape, is_a_minimum_for_the_membrane_of_the_laws) {
  for (const BendingLaw law : {BendingLaw::turning_angle, BendingLaw::half_angle_tangent}) {
    Deflation d = cell;
    d.bending_law = law;
    const RestShape shape = deflate(d, 59);
    const MembraneParameters p{.stretch_law = StretchLaw::inextensible,
                               .bending_modulus = 2e-19,
                               .bending_law = law,
                               .natural_shape = NaturalShape::flat,
                               .area_law = AreaLaw::exact};
    const RingMembrane membrane(make_ring_mesh(shape.nodes, NaturalShape::flat), p);
    test::Polygon forces(59);
    membrane.forces(shape.nodes, forces);
    const Eigen::Map<const Eigen::VectorXd> bending(forces[0].data(), 118);
    Eigen::MatrixXd balance = Eigen::MatrixXd::Zero(118, 60);
    for (Eigen::Index j = 0; j < 59; ++j) {
      const Eigen::Index next = (j + 1) % 59;
      const Vector<2> along =
          (shape.nodes[static_cast<std::size_t>(next)] - shape.nodes[static_cast<std::size_t>(j)])
              .normalized();
      balance.block<2, 1>(2 * j, j) = along;
      balance.block<2, 1>(2 * next, j) = -along;
      const Vector<2> normal(along.y(), -along.x());
      balance.block<2, 1>(2 * j, 59) += normal;
      balance.block<2, 1>(2 * next, 59) += normal;
    }
    const Eigen::VectorXd loads = balance.colPivHouseholderQr().solve(-bending);
    EXPECT_LE((balance * loads + bending).norm(), 1e-9 * bending.norm());
    EXPECT_LE(shape.largest_residual, 1e-10);
    const double unit = 2 * pi * 2e-19 / d.perimeter;  // kappa / R0
    EXPECT_NEAR(shape.bending_energy * unit, membrane.energy(shape.nodes).bending, 1e-12 * unit);
  }
}

TEST(RestShape, reduced_area_one_is_the_regular_polygon) {
  Deflation d = cell;
  d.reduced_area = 1;
  const RestShape shape = deflate(d, 59);
  const double radius = d.perimeter / (2 * 59 * std::sin(pi / 59));
  const test::Polygon circle = test::regular_polygon(59, radius);
  for (std::size_t i = 0; i < 59; ++i) {
    EXPECT_LE((shape.nodes[i] - circle[i]).norm(), 1e-12 * radius);
  }
  EXPECT_NEAR(shape.bending_energy, pi, 1e-12);
}

std::string message_of(const Deflation& d, int nodes) {
  try {
    deflate(d, nodes);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(RestShape, refuses_what_has_no_shape) {
  EXPECT_THAT(message_of(cell, 7), HasSubstr("at least 8"));
  Deflation d = cell;
  for (const double area : {0.0, -0.3, 1.01, std::nan("")}) {
    d.reduced_area = area;
    EXPECT_THAT(message_of(d, 59), HasSubstr("it must lie in (0, 1]"));
  }
  d = cell;
  d.perimeter = 0;
  EXPECT_THAT(message_of(d, 59), HasSubstr("finite and positive"));
}

// Opposite sides of 59 nodes touch at 0.270, of the smooth curve at 0.271.
TEST(RestShape, refuses_a_reduced_area_below_contact) {
  Deflation d = cell;
  d.reduced_area = 0.272;
  const auto gap = closest_across(deflate(d, 59).nodes);
  ASSERT_TRUE(gap);
  EXPECT_LT(gap->distance, 0.01 * d.perimeter / (2 * pi));
  for (const double area : {0.268, 0.2, 0.05}) {
    d.reduced_area = area;
    EXPECT_THAT(message_of(d, 59), HasSubstr("pass through each other"));
  }
}

// Gradient and Hessian of the conditions, away from the solution.
TEST(DeflationSystem, derivatives_agree_with_differences) {
  for (const BendingLaw law : {BendingLaw::turning_angle, BendingLaw::half_angle_tangent}) {
    const DeflationSystem system(11, law);
    Eigen::VectorXd unknowns = system.start(0.5);
    for (Eigen::Index i = 0; i < unknowns.size(); ++i) {
      unknowns(i) += 0.3 * uniform({5, 0, static_cast<std::uint64_t>(i)});
    }
    Eigen::VectorXd gradient;
    Eigen::MatrixXd hessian;
    system.assemble(unknowns, 1.2, gradient, hessian);
    EXPECT_NEAR(gradient(11 + DeflationSystem::area_condition), system.area(unknowns) - 1.2, 1e-14);
    // Without multipliers the gradient is that of the energy.
    Eigen::VectorXd free = unknowns;
    free.tail<DeflationSystem::conditions>().setZero();
    Eigen::VectorXd energy_gradient;
    Eigen::MatrixXd ignored;
    system.assemble(free, 1.2, energy_gradient, ignored);
    for (Eigen::Index j = 0; j < unknowns.size(); ++j) {
      const double h = 1e-5;
      const auto at = [&](double shift) {
        Eigen::VectorXd moved = unknowns;
        moved(j) += shift;
        Eigen::VectorXd result;
        system.assemble(moved, 1.2, result, ignored);
        return result;
      };
      const Eigen::VectorXd slope = (at(h) - at(-h)) / (2 * h);
      for (Eigen::Index i = 0; i < unknowns.size(); ++i) {
        EXPECT_NEAR(i >= j ? hessian(i, j) : hessian(j, i), slope(i), 1e-7) << i << ", " << j;
      }
      if (j < 11) {
        Eigen::VectorXd up = free;
        Eigen::VectorXd down = free;
        up(j) += h;
        down(j) -= h;
        EXPECT_NEAR(energy_gradient(j), (system.energy(up) - system.energy(down)) / (2 * h), 1e-7);
      }
    }
  }
}

TEST(SolveSymmetric, counts_negative_eigenvalues) {
  Eigen::MatrixXd matrix(3, 3);
  matrix << 0, 2, 0, 2, 0, 0, 0, 0, -3;  // eigenvalues 2, -2, -3
  Eigen::MatrixXd right(3, 1);
  right << 2, 4, 6;
  EXPECT_EQ(solve_symmetric(matrix, right), 2);
  EXPECT_LE((right - Eigen::Vector3d(2, 1, -2)).norm(), 1e-14);
  matrix.setIdentity();
  EXPECT_EQ(solve_symmetric(matrix, right), 0);
  matrix.setZero();
  EXPECT_EQ(solve_symmetric(matrix, right), -1);
}

}  // namespace
}  // namespace hemoscale::micro
