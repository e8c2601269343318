#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <type_traits>

#include "micro/cells/area.hpp"
#include "micro/cells/half_angle_bending.hpp"
#include "micro/cells/line_element_stretch.hpp"
#include "micro/cells/stretch.hpp"
#include "micro/cells/turning_angle_bending.hpp"
#include "tests/support/micro/rings.hpp"

// One typed test for the second derivatives of all membrane laws: a new law joins by its line in
// `Laws`.
namespace hemoscale::micro {
namespace {

using test::Polygon;

template <class Law>
class MembraneStiffness : public testing::Test {
 protected:
  static constexpr int nodes = 30;
  static constexpr int trials = 20;
  Law law{3.0};
};

using Laws =
    testing::Types<Stretch, LineElementStretch, TurningAngleBending, HalfAngleBending, AreaPenalty>;
TYPED_TEST_SUITE(MembraneStiffness, Laws);

template <class Law>
Eigen::MatrixXd stiffness_of(const Law& law, const RingMesh& mesh, const Polygon& polygon,
                             Compression compression = Compression::full) {
  const test::Coordinates c(polygon);
  RingGeometry ring(mesh.nodes);
  measure(c.x.data(), c.y.data(), ring);
  RingStiffness stiffness(polygon.size());
  add_stiffness(law, mesh, ring, compression, stiffness);
  return dense(stiffness);
}

Eigen::VectorXd stacked(const Polygon& vectors) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(2 * vectors.size()));
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    result.segment<2>(static_cast<Eigen::Index>(2 * i)) = vectors[i];
  }
  return result;
}

Polygon turned_by_quarter(Polygon vectors) {
  for (auto& v : vectors) {
    v = Vector<2>(-v.y(), v.x());
  }
  return vectors;
}

Polygon scaled(Polygon polygon, double factor) {
  for (auto& node : polygon) {
    node *= factor;
  }
  return polygon;
}

template <class Law>
constexpr bool has_tension =
    std::is_same_v<Law, Stretch> || std::is_same_v<Law, LineElementStretch>;

template <class Law>
void expect_gradient_of_force(const Law& law, const RingMesh& mesh, const Polygon& polygon) {
  const Eigen::MatrixXd stiffness = stiffness_of(law, mesh, polygon);
  const double scale = stiffness.cwiseAbs().maxCoeff();
  ASSERT_GT(scale, 0);
  const double h = 1e-4 * mesh.rest_perimeter / mesh.nodes;
  for (std::size_t j = 0; j < polygon.size(); ++j) {
    for (int axis = 0; axis < 2; ++axis) {
      const auto forces_at = [&](double shift) {
        Polygon moved = polygon;
        moved[j](axis) += shift;
        return stacked(test::ring_forces_of(law, mesh, moved));
      };
      // Central differences of fourth order: the laws stiffen sharply at acute angles.
      const Eigen::VectorXd slope =
          (8 * (forces_at(h) - forces_at(-h)) - (forces_at(2 * h) - forces_at(-2 * h))) / (12 * h);
      const auto column = static_cast<Eigen::Index>(2 * j) + axis;
      EXPECT_LE((stiffness.col(column) + slope).cwiseAbs().maxCoeff(), 1e-7 * scale)
          << "node " << j;
    }
  }
}

TYPED_TEST(MembraneStiffness, is_the_gradient_of_minus_the_force) {
  for (const NaturalShape natural : {NaturalShape::flat, NaturalShape::outline}) {
    for (std::uint64_t trial = 0; trial < this->trials; ++trial) {
      const RingMesh mesh = make_ring_mesh(test::random_polygon(this->nodes, 2 * trial), natural);
      expect_gradient_of_force(this->law, mesh, test::random_polygon(this->nodes, 2 * trial + 1));
    }
  }
}

// Blocks of the smallest rings fall on each other.
TYPED_TEST(MembraneStiffness, holds_for_the_smallest_rings) {
  for (const int few : {3, 4, 5}) {
    const RingMesh mesh = make_ring_mesh(test::regular_polygon(few, 3e-6), NaturalShape::flat);
    expect_gradient_of_force(this->law, mesh, test::random_polygon(few, 1));
  }
}

TYPED_TEST(MembraneStiffness, is_symmetric_and_does_not_resist_translation) {
  for (std::uint64_t trial = 0; trial < this->trials; ++trial) {
    const RingMesh mesh =
        make_ring_mesh(test::random_polygon(this->nodes, 2 * trial), NaturalShape::outline);
    const Eigen::MatrixXd stiffness =
        stiffness_of(this->law, mesh, test::random_polygon(this->nodes, 2 * trial + 1));
    const double scale = stiffness.cwiseAbs().maxCoeff();
    EXPECT_LE((stiffness - stiffness.transpose()).cwiseAbs().maxCoeff(), 1e-13 * scale);
    for (const Vector<2>& direction : {Vector<2>(1, 0), Vector<2>(0, 1)}) {
      const Eigen::VectorXd shift =
          stacked(Polygon(static_cast<std::size_t>(this->nodes), direction));
      EXPECT_LE((stiffness * shift).cwiseAbs().maxCoeff(), 1e-12 * scale);
    }
  }
}

// F(R x) = R F(x), differentiated with respect to the angle: H (J x) = -J F.
TYPED_TEST(MembraneStiffness, turns_the_force_with_the_ring) {
  for (std::uint64_t trial = 0; trial < this->trials; ++trial) {
    const RingMesh mesh =
        make_ring_mesh(test::random_polygon(this->nodes, 2 * trial), NaturalShape::outline);
    const Polygon polygon = test::random_polygon(this->nodes, 2 * trial + 1);
    const Eigen::MatrixXd stiffness = stiffness_of(this->law, mesh, polygon);
    const Eigen::VectorXd turned = stacked(turned_by_quarter(polygon));
    const Eigen::VectorXd force =
        stacked(turned_by_quarter(test::ring_forces_of(this->law, mesh, polygon)));
    EXPECT_GT(force.norm(), 0);
    EXPECT_LE((stiffness * turned + force).norm(), 1e-12 * stiffness.norm() * turned.norm());
  }
}

TYPED_TEST(MembraneStiffness, drops_nothing_but_compression) {
  using Law = TypeParam;
  for (std::uint64_t trial = 0; trial < this->trials; ++trial) {
    const Polygon reference = test::random_polygon(this->nodes, trial);
    const RingMesh mesh = make_ring_mesh(reference, NaturalShape::outline);
    // Scaled: segments of laws with tension are all pulled, or all pushed.
    for (const double factor : {1.5, 0.7}) {
      const Polygon polygon = scaled(reference, factor);
      const Eigen::MatrixXd full = stiffness_of(this->law, mesh, polygon);
      const Eigen::MatrixXd dropped = stiffness_of(this->law, mesh, polygon, Compression::dropped);
      EXPECT_EQ(full == dropped, !(has_tension<Law> && factor < 1));
    }
  }
}

template <class Law>
void expect_semidefinite_where_dropped(const Law& law) {
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    const RingMesh mesh =
        make_ring_mesh(test::random_polygon(30, 2 * trial), NaturalShape::outline);
    for (const double factor : {0.5, 1.0, 2.0}) {
      const Polygon polygon = scaled(test::random_polygon(30, 2 * trial + 1), factor);
      using Solver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
      const Eigen::VectorXd dropped =
          Solver(stiffness_of(law, mesh, polygon, Compression::dropped)).eigenvalues();
      EXPECT_GE(dropped.minCoeff(), -1e-12 * dropped.maxCoeff());
      if (factor < 1) {  // the full matrix is indefinite, or the test would show nothing
        const Eigen::VectorXd full = Solver(stiffness_of(law, mesh, polygon)).eigenvalues();
        EXPECT_LT(full.minCoeff(), -1e-3 * full.maxCoeff());
      }
    }
  }
}

TEST(MembraneCompression, dropped_stretching_is_positive_semidefinite) {
  expect_semidefinite_where_dropped(Stretch{3.0});
  expect_semidefinite_where_dropped(LineElementStretch{3.0});
}

}  // namespace
}  // namespace hemoscale::micro
