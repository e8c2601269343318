#include <gtest/gtest.h>

#include <string>

#include "tests/support/micro/blocks.hpp"

// The explicit kernel against the laws of micro/cells: the displacement of one step is
// dt u + tau F, for every lane of a block in a shape of its own.
namespace hemoscale::micro {
namespace {

using blocks::kernel_index;
using test::KernelBlock;
using test::Polygon;
using test::um;

constexpr double tau = 3e-3;  // [m/N] dt / zeta of a step near the explicit limit

MembraneParameters membrane(BendingLaw law) {
  MembraneParameters p;
  p.bending_law = law;
  p.area_modulus = 5;
  return p;
}

/// tau F of the membrane alone [um].
Polygon membrane_displacements(const RingMesh& mesh, const MembraneLaws& laws, double factor,
                               const Polygon& polygon) {
  const test::Coordinates c(polygon);
  RingGeometry geometry(mesh.nodes);
  std::vector<double> fx(polygon.size());
  std::vector<double> fy(polygon.size());
  ring_forces(laws, mesh, c.x.data(), c.y.data(), geometry, fx.data(), fy.data());
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    result.emplace_back(factor * fx[i], factor * fy[i]);
  }
  return result;
}

template <class Real>
class BlockExplicitKernel : public testing::Test {
 protected:
  static constexpr std::size_t width = KernelBlock<Real>::width;
  // Of the largest displacement by the membrane.
  static constexpr double tolerance = sizeof(Real) == 4 ? 5e-5 : 1e-12;

  struct Step {
    std::vector<Polygon> wanted, made;  // [um] by lane
    double scale = 0;                   // [um] largest displacement by the membrane of any lane
    double largest_angle = 0;           // [rad]
  };

  /// One step of a block whose lanes hold different shapes.
  static Step step(const blocks::Kernels<Real>& version, int nodes, BendingLaw law,
                   const test::BlockSituation& situation, double waves, double roughness) {
    const MembraneLaws laws = make_membrane_laws(membrane(law));
    const RingMesh mesh =
        make_ring_mesh(test::dented_polygon(nodes, 1, 0.05, 0.02), NaturalShape::outline);
    KernelBlock<Real> block(mesh, laws, tau);
    for (std::size_t lane = 0; lane < width; ++lane) {
      block.set(lane, test::dented_polygon(nodes, 100 + lane, waves, roughness));
    }
    Step result;
    for (std::size_t lane = 0; lane < width; ++lane) {
      const Polygon before = block.get(lane);
      result.wanted.push_back(membrane_displacements(mesh, laws, block.tau_over_um, before));
      result.scale = std::max(result.scale, test::largest_norm(result.wanted.back()));
      for (std::size_t i = 0; i < before.size(); ++i) {
        const Vector<2> a = before[(i + 1) % before.size()] - before[i];
        const Vector<2> b = before[(i + 2) % before.size()] - before[(i + 1) % before.size()];
        result.largest_angle = std::max(
            result.largest_angle, std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b))));
      }
    }
    test::disturb(block, situation, 0.3 * result.scale, 7);
    std::vector<Polygon> before;
    for (std::size_t lane = 0; lane < width; ++lane) {
      before.push_back(block.get(lane));
      for (std::size_t i = 0; i < block.nodes; ++i) {
        const Vector<2> offset = before[lane][i] / um;
        Vector<2>& d = result.wanted[lane][i];
        d += block.flow_at(lane, offset.x(), offset.y());
        d.x() += static_cast<double>(block.force_x[i * width + lane]);
        d.y() += static_cast<double>(block.force_y[i * width + lane]);
        if (situation.walls) d.y() += block.wall_at(lane, offset.y()).x();
      }
    }
    version.explicit_step[kernel_index(situation.choice(block.half_angle))](block.arguments());
    for (std::size_t lane = 0; lane < width; ++lane) {
      const Polygon after = block.get(lane);
      result.made.emplace_back();
      for (std::size_t i = 0; i < block.nodes; ++i) {
        // What rounding kept from the position is in the memory.
        result.made[lane].push_back(
            (after[i] - before[lane][i]) / um +
            Vector<2>(static_cast<double>(block.memory_x[i * width + lane]),
                      static_cast<double>(block.memory_y[i * width + lane])));
      }
    }
    return result;
  }

  static double error(const Step& step) {
    double largest = 0;
    for (std::size_t lane = 0; lane < width; ++lane) {
      for (std::size_t i = 0; i < step.wanted[lane].size(); ++i) {
        largest = std::max(largest, (step.made[lane][i] - step.wanted[lane][i]).norm());
      }
    }
    return largest / step.scale;
  }
};
TYPED_TEST_SUITE(BlockExplicitKernel, test::Reals);

TYPED_TEST(BlockExplicitKernel, makes_the_step_of_the_reference_laws) {
  for (const auto* version : test::kernel_versions<TypeParam>()) {
    for (const BendingLaw law : {BendingLaw::turning_angle, BendingLaw::half_angle_tangent}) {
      for (const bool parallel : {true, false}) {
        for (const bool walls : {false, true}) {
          for (const int nodes : {59, 100, 101}) {
            const auto step = this->step(*version, nodes, law, {parallel, walls}, 0.15, 0.03);
            EXPECT_LE(this->error(step), this->tolerance)
                << version->name << ", " << nodes << " nodes, half angle "
                << (law == BendingLaw::half_angle_tangent) << ", parallel " << parallel
                << ", walls " << walls;
          }
        }
      }
    }
  }
}

// Coarse rings turn by more than 45 degrees at a node, where the polynomial of the inverse tangent
// does not hold.
TYPED_TEST(BlockExplicitKernel, holds_at_large_turning_angles) {
  for (const auto* version : test::kernel_versions<TypeParam>()) {
    for (const BendingLaw law : {BendingLaw::turning_angle, BendingLaw::half_angle_tangent}) {
      for (const int nodes : {8, 9, 13, 24}) {
        const auto step = this->step(*version, nodes, law, {}, 0.3, 0.2);
        EXPECT_GT(step.largest_angle, 1.1);
        EXPECT_LE(this->error(step), this->tolerance) << version->name << ", " << nodes << " nodes";
      }
    }
  }
}

// Cells do not see who shares their block: an idle lane, or one that folds, changes no bit.
TYPED_TEST(BlockExplicitKernel, lanes_do_not_touch_each_other) {
  const MembraneLaws laws = make_membrane_laws(membrane(BendingLaw::turning_angle));
  const RingMesh mesh = make_ring_mesh(test::dented_polygon(30, 1, 0, 0), NaturalShape::outline);
  for (const auto* version : test::kernel_versions<TypeParam>()) {
    const auto after = [&](double roughness) {
      KernelBlock<TypeParam> block(mesh, laws, tau);
      for (std::size_t lane = 0; lane < block.width; ++lane) {
        block.set(lane, test::dented_polygon(30, lane, 0.1, lane == 2 ? 0.05 : roughness));
      }
      version->explicit_step[kernel_index({})](block.arguments());
      return block.get(2);
    };
    EXPECT_EQ(after(0.0), after(0.4)) << version->name;
  }
}

// Single precision: many steps, each of them below half a unit in the last place of the offset.
TYPED_TEST(BlockExplicitKernel, remembers_what_rounding_drops) {
  const RingMesh mesh = make_ring_mesh(test::regular_polygon(16, 3 * um), NaturalShape::outline);
  for (const auto* version : test::kernel_versions<TypeParam>()) {
    KernelBlock<TypeParam> block(mesh, make_membrane_laws({}), 0);
    block.set(0, test::regular_polygon(16, 3 * um));
    const double before = static_cast<double>(block.x[0]);
    const auto step = static_cast<TypeParam>(1e-8);  // [um]
    for (auto& f : block.force_x) f = step;
    for (int i = 0; i < 10000; ++i) version->explicit_step[kernel_index({})](block.arguments());
    EXPECT_NEAR(static_cast<double>(block.x[0]) - before, 1e-4, 3e-7) << version->name;
  }
}

// Every law by itself, as the kernel sees it: minus the gradient of the energy of the ring.
TEST(BlockKernelEnergy, force_is_minus_its_gradient) {
  constexpr int nodes = 40;
  const RingMesh mesh =
      make_ring_mesh(test::dented_polygon(nodes, 1, 0.05, 0.02), NaturalShape::outline);
  for (const BendingLaw bending : {BendingLaw::turning_angle, BendingLaw::half_angle_tangent}) {
    for (int part = 0; part < 4; ++part) {
      MembraneParameters p = membrane(bending);
      if (part != 0 && part != 3) p.stretch_modulus = 0;
      if (part != 1 && part != 3) p.bending_modulus = 0;
      if (part != 2 && part != 3) p.area_modulus = 0;
      const MembraneLaws laws = make_membrane_laws(p);
      KernelBlock<double> block(mesh, laws, um);  // displacement [um] = force [N/m]
      for (std::size_t lane = 0; lane < block.width; ++lane) {
        block.set(lane, test::dented_polygon(nodes, 50 + lane));
      }
      const Polygon polygon = block.get(3);
      blocks::kernels<double>().explicit_step[kernel_index({block.half_angle, true, false})](
          block.arguments());
      const Polygon after = block.get(3);
      RingGeometry geometry(nodes);
      const auto energy = [&](const Polygon& shape) {
        const test::Coordinates c(shape);
        return ring_energy(laws, mesh, c.x.data(), c.y.data(), geometry);
      };
      Polygon gradient;
      const double h = 1e-4 * mesh.rest_perimeter / nodes;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        Vector<2> slope;
        for (int axis = 0; axis < 2; ++axis) {
          const auto at = [&](double shift) {
            Polygon moved = polygon;
            moved[i](axis) += shift;
            return energy(moved);
          };
          slope(axis) = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
        }
        gradient.push_back(slope);
      }
      const double scale = test::largest_norm(gradient);
      ASSERT_GT(scale, 0);
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector<2> force =
            (after[i] - polygon[i]) / um +
            Vector<2>(block.memory_x[i * block.width + 3], block.memory_y[i * block.width + 3]);
        EXPECT_LE((force + gradient[i]).norm(), 1e-7 * scale) << "part " << part << ", node " << i;
      }
    }
  }
}

}  // namespace
}  // namespace hemoscale::micro
