#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "micro/cells/area.hpp"
#include "micro/cells/half_angle_bending.hpp"
#include "micro/cells/line_element_stretch.hpp"
#include "micro/cells/stretch.hpp"
#include "micro/cells/turning_angle_bending.hpp"
#include "tests/support/micro/rings.hpp"

// One typed test for all membrane laws: a new law joins by its line in `Laws`.
namespace hemoscale::micro {
namespace {

using test::Polygon;

template <class Law>
class MembraneLaw : public testing::Test {
 protected:
  static constexpr int nodes = 30;
  static constexpr int trials = 20;
  Law law{3.0};
};

using Laws =
    testing::Types<Stretch, LineElementStretch, TurningAngleBending, HalfAngleBending, AreaPenalty>;
TYPED_TEST_SUITE(MembraneLaw, Laws);

TEST(RandomPolygon, turns_to_both_sides) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const RingMesh mesh = make_ring_mesh(test::random_polygon(30, seed), NaturalShape::outline);
    EXPECT_LT(*std::min_element(mesh.natural_angle.begin(), mesh.natural_angle.end()), 0);
  }
}

TYPED_TEST(MembraneLaw, force_is_minus_gradient_of_energy) {
  for (const NaturalShape natural : {NaturalShape::flat, NaturalShape::outline}) {
    for (std::uint64_t trial = 0; trial < this->trials; ++trial) {
      const RingMesh mesh = make_ring_mesh(test::random_polygon(this->nodes, 2 * trial), natural);
      const Polygon polygon = test::random_polygon(this->nodes, 2 * trial + 1);
      const Polygon forces = test::ring_forces_of(this->law, mesh, polygon);
      const double scale = test::largest_norm(forces);
      ASSERT_GT(scale, 0);
      const double h = 1e-4 * mesh.rest_perimeter / this->nodes;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        for (int axis = 0; axis < 2; ++axis) {
          const auto energy_at = [&](double shift) {
            Polygon moved = polygon;
            moved[i](axis) += shift;
            return test::ring_energy_of(this->law, mesh, moved);
          };
          // Central differences of fourth order: the laws stiffen sharply at acute angles.
          const double slope =
              (8 * (energy_at(h) - energy_at(-h)) - (energy_at(2 * h) - energy_at(-2 * h))) /
              (12 * h);
          EXPECT_NEAR(forces[i](axis), -slope, 1e-7 * scale) << "seed " << trial << ", node " << i;
        }
      }
    }
  }
}

TYPED_TEST(MembraneLaw, exerts_neither_net_force_nor_torque) {
  for (std::uint64_t trial = 0; trial < this->trials; ++trial) {
    const RingMesh mesh =
        make_ring_mesh(test::random_polygon(this->nodes, 2 * trial), NaturalShape::outline);
    const Polygon polygon = test::random_polygon(this->nodes, 2 * trial + 1);
    const Polygon forces = test::ring_forces_of(this->law, mesh, polygon);
    Vector<2> force = Vector<2>::Zero();
    double torque = 0;
    double force_scale = 0;
    double torque_scale = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      force += forces[i];
      torque += polygon[i].x() * forces[i].y() - polygon[i].y() * forces[i].x();
      force_scale += forces[i].norm();
      torque_scale += forces[i].norm() * polygon[i].norm();
    }
    EXPECT_LE(force.norm(), 1e-13 * force_scale);
    EXPECT_LE(std::abs(torque), 1e-13 * torque_scale);
  }
}

TYPED_TEST(MembraneLaw, turns_with_the_ring) {
  for (std::uint64_t trial = 0; trial < this->trials; ++trial) {
    const RingMesh mesh =
        make_ring_mesh(test::random_polygon(this->nodes, 2 * trial), NaturalShape::outline);
    const Polygon polygon = test::random_polygon(this->nodes, 2 * trial + 1);
    const Eigen::Rotation2D<double> rotation(6.28 * uniform({trial, 7, 0}));
    Polygon turned = polygon;
    for (auto& node : turned) {
      node = (rotation * node + Vector<2>(4e-6, -3e-6)).eval();
    }
    const double before = test::ring_energy_of(this->law, mesh, polygon);
    EXPECT_NEAR(test::ring_energy_of(this->law, mesh, turned), before, 1e-12 * before);
    const Polygon forces = test::ring_forces_of(this->law, mesh, polygon);
    const Polygon turned_forces = test::ring_forces_of(this->law, mesh, turned);
    const double scale = test::largest_norm(forces);
    for (std::size_t i = 0; i < forces.size(); ++i) {
      EXPECT_LE((turned_forces[i] - rotation * forces[i]).norm(), 1e-11 * scale);
    }
  }
}

TYPED_TEST(MembraneLaw, does_not_know_the_first_node) {
  const Polygon reference = test::random_polygon(this->nodes, 1);
  const Polygon polygon = test::random_polygon(this->nodes, 2);
  const auto renumbered = [](Polygon p) {
    std::rotate(p.begin(), p.begin() + 11, p.end());
    return p;
  };
  const RingMesh mesh = make_ring_mesh(reference, NaturalShape::outline);
  const RingMesh other = make_ring_mesh(renumbered(reference), NaturalShape::outline);
  const double before = test::ring_energy_of(this->law, mesh, polygon);
  EXPECT_NEAR(test::ring_energy_of(this->law, other, renumbered(polygon)), before, 1e-13 * before);
  const Polygon expected = renumbered(test::ring_forces_of(this->law, mesh, polygon));
  const Polygon forces = test::ring_forces_of(this->law, other, renumbered(polygon));
  for (std::size_t i = 0; i < forces.size(); ++i) {
    EXPECT_LE((forces[i] - expected[i]).norm(), 1e-12 * test::largest_norm(expected));
  }
}

TYPED_TEST(MembraneLaw, vanishes_at_the_reference_shape) {
  for (std::uint64_t trial = 0; trial < this->trials; ++trial) {
    const Polygon reference = test::random_polygon(this->nodes, trial);
    const RingMesh mesh = make_ring_mesh(reference, NaturalShape::outline);
    const Polygon other = test::random_polygon(this->nodes, trial + 1000);
    EXPECT_LE(test::ring_energy_of(this->law, mesh, reference),
              1e-24 * test::ring_energy_of(this->law, mesh, other));
    EXPECT_LE(test::largest_norm(test::ring_forces_of(this->law, mesh, reference)),
              1e-12 * test::largest_norm(test::ring_forces_of(this->law, mesh, other)));
  }
}

}  // namespace
}  // namespace hemoscale::micro
