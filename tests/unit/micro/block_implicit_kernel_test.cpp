#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "micro/cells/ring_membrane.hpp"
#include "tests/support/micro/blocks.hpp"

// The linearly implicit kernel against a dense solver: (I + tau K) d = r with the exact second
// derivative of the membrane of micro/cells, stiff contacts and walls on the diagonal, and r the
// displacement of the explicit step.
namespace hemoscale::micro {
namespace {

using blocks::kernel_index;
using test::KernelBlock;
using test::Polygon;
using test::um;

struct Membrane {
  const char* name;
  BendingLaw law = BendingLaw::turning_angle;
  double stretch = 5e-6, bending = 2e-19, area = 5;  // [N/m], [J], [Pa]
};

MembraneParameters parameters(const Membrane& m) {
  MembraneParameters p;
  p.bending_law = m.law;
  p.stretch_modulus = m.stretch;
  p.bending_modulus = m.bending;
  p.area_modulus = m.area;
  return p;
}

struct Problem {
  int nodes = 100;
  double times_stiffness = 1;  // [-] tau times the largest eigenvalue of the rest shape, about
  test::BlockSituation situation = {};
  double contact = 0;       // [-] largest stiffness of contacts times tau
  double inflation = 1.03;  // [-] pulled segments: I + tau K stays definite for any tau
};

/// Largest error of d of any lane, relative to the largest d of the lane.
template <class Real>
double error(const blocks::Kernels<Real>& version, const Membrane& membrane,
             const Problem& problem) {
  constexpr std::size_t width = KernelBlock<Real>::width;
  const Polygon outline = test::dented_polygon(problem.nodes, 1, 0.05, 0.02);
  const RingMembrane reference(make_ring_mesh(outline, NaturalShape::outline),
                               parameters(membrane));
  const RingMesh& mesh = reference.mesh();
  const double l0 = mesh.rest_perimeter / problem.nodes;
  const double stiffness = 4 * 5e-6 / l0 + 16 * 2e-19 / (l0 * l0 * l0);
  const double tau = problem.times_stiffness / stiffness;
  KernelBlock<Real> block(mesh, make_membrane_laws(parameters(membrane)), tau);
  for (std::size_t lane = 0; lane < width; ++lane) {
    // The outline, turned, a little sheared by a number of the lane, and swollen.
    Polygon polygon;
    const double angle = 0.7 * static_cast<double>(lane);
    const double shear = 0.02 * (static_cast<double>(lane % 5) - 2);
    for (const Vector<2>& p : outline) {
      const Vector<2> q(p.x() + shear * p.y(), p.y());
      polygon.emplace_back(problem.inflation * (std::cos(angle) * q.x() - std::sin(angle) * q.y()),
                           problem.inflation * (std::sin(angle) * q.x() + std::cos(angle) * q.y()));
    }
    block.set(lane, polygon);
  }
  test::disturb(block, problem.situation, 0.01, 7);
  if (problem.situation.walls) block.walls.stiffness = static_cast<Real>(problem.contact);
  for (std::size_t i = 0; i < block.kxx.size(); ++i) {
    // Sum of outer products, as contacts make it, on every third node.
    if (i / width % 3 != 0) continue;
    const auto draw = [&](std::uint64_t stream) { return uniform({9, stream, i}) - 0.5; };
    const Vector<2> a(draw(0), draw(1));
    const Vector<2> b(draw(2), draw(3));
    block.kxx[i] = static_cast<Real>(problem.contact * (a.x() * a.x() + b.x() * b.x()));
    block.kxy[i] = static_cast<Real>(problem.contact * (a.x() * a.y() + b.x() * b.y()));
    block.kyy[i] = static_cast<Real>(problem.contact * (a.y() * a.y() + b.y() * b.y()));
  }

  std::vector<Polygon> before;
  for (std::size_t lane = 0; lane < width; ++lane) before.push_back(block.get(lane));
  version.implicit_step[kernel_index(problem.situation.choice(block.half_angle))](
      block.arguments());

  double largest = 0;
  RingStiffness k(block.nodes);
  Polygon forces(block.nodes);
  for (std::size_t lane = 0; lane < width; ++lane) {
    reference.stiffness(before[lane], Compression::full, k);
    reference.forces(before[lane], forces);
    Eigen::MatrixXd matrix = tau * dense(k);
    matrix.diagonal().array() += 1;
    Eigen::VectorXd r(matrix.rows());
    for (std::size_t i = 0; i < block.nodes; ++i) {
      const auto at = static_cast<Eigen::Index>(2 * i);
      const std::size_t entry = i * width + lane;
      const Vector<2> offset = before[lane][i] / um;
      const Vector<2> wall =
          problem.situation.walls ? block.wall_at(lane, offset.y()) : Vector<2>(0, 0);
      r.segment<2>(at) = block.tau_over_um * forces[i] +
                         block.flow_at(lane, offset.x(), offset.y()) +
                         Vector<2>(static_cast<double>(block.force_x[entry]),
                                   static_cast<double>(block.force_y[entry]) + wall.x());
      const auto kxy = static_cast<double>(block.kxy[entry]);
      matrix(at, at) += static_cast<double>(block.kxx[entry]);
      matrix(at, at + 1) += kxy;
      matrix(at + 1, at) += kxy;
      matrix(at + 1, at + 1) += static_cast<double>(block.kyy[entry]) + wall.y();
    }
    const Eigen::VectorXd wanted = matrix.partialPivLu().solve(r);
    const Polygon after = block.get(lane);
    double difference = 0;
    for (std::size_t i = 0; i < block.nodes; ++i) {
      const Vector<2> made = (after[i] - before[lane][i]) / um;
      const double d = (made - wanted.segment<2>(static_cast<Eigen::Index>(2 * i))).norm();
      difference = std::isfinite(d) ? std::max(difference, d) : d;
      if (!std::isfinite(d)) return d;
    }
    largest = std::max(largest, difference / wanted.cwiseAbs().maxCoeff());
  }
  return largest;
}

template <class Real>
class BlockImplicitKernel : public testing::Test {
 protected:
  static constexpr double tolerance = sizeof(Real) == 4 ? 1e-4 : 1e-12;

  static void expect_solved(const Membrane& membrane, const Problem& problem) {
    for (const auto* version : test::kernel_versions<Real>()) {
      const double found = error(*version, membrane, problem);
      EXPECT_LE(found, tolerance) << version->name << ", " << membrane.name << ", " << problem.nodes
                                  << " nodes, tau times stiffness " << problem.times_stiffness
                                  << ", contacts " << problem.contact << ", parallel "
                                  << problem.situation.parallel_flow << ", walls "
                                  << problem.situation.walls;
    }
  }
};
TYPED_TEST_SUITE(BlockImplicitKernel, test::Reals);

constexpr Membrane turning{.name = "turning angles"};
constexpr Membrane half{.name = "half angles", .law = BendingLaw::half_angle_tangent};

TYPED_TEST(BlockImplicitKernel, solves_the_dense_system_at_any_step) {
  for (const Membrane& membrane : {turning, half}) {
    for (const double tau : {1e-6, 1e-3, 1.0, 30.0, 1e3}) {
      this->expect_solved(membrane, {.times_stiffness = tau});
    }
  }
}

TYPED_TEST(BlockImplicitKernel, solves_rings_of_any_number_of_nodes) {
  for (const Membrane& membrane : {turning, half}) {
    for (const int nodes : {8, 9, 59, 61, 100, 101}) {
      this->expect_solved(membrane, {.nodes = nodes, .times_stiffness = 30});
    }
  }
}

TYPED_TEST(BlockImplicitKernel, holds_contacts_walls_and_general_flows_on_the_diagonal) {
  for (const Membrane& membrane : {turning, half}) {
    for (const bool parallel : {true, false}) {
      for (const bool walls : {true, false}) {
        this->expect_solved(
            membrane,
            {.nodes = 61, .times_stiffness = 30, .situation = {parallel, walls}, .contact = 50});
      }
    }
  }
}

// Pushed segments have a negative stiffness across: the system is definite for small steps alone.
TYPED_TEST(BlockImplicitKernel, keeps_the_stiffness_of_pushed_segments) {
  for (const Membrane& membrane : {turning, half}) {
    this->expect_solved(membrane, {.times_stiffness = 1, .inflation = 0.9});
  }
}

TYPED_TEST(BlockImplicitKernel, any_modulus_may_be_zero) {
  for (const BendingLaw law : {BendingLaw::turning_angle, BendingLaw::half_angle_tangent}) {
    for (const double tau : {1.0, 30.0}) {
      this->expect_solved({.name = "no bending", .law = law, .bending = 0},
                          {.times_stiffness = tau});
      this->expect_solved({.name = "no area law", .law = law, .area = 0}, {.times_stiffness = tau});
      this->expect_solved({.name = "no stretching", .law = law, .stretch = 0},
                          {.times_stiffness = 0.1 * tau});
      this->expect_solved({.name = "none", .law = law, .stretch = 0, .bending = 0, .area = 0},
                          {.times_stiffness = tau});
    }
  }
}

// Cells do not see who shares their block, nor in which lane they are.
TYPED_TEST(BlockImplicitKernel, lanes_do_not_touch_each_other) {
  constexpr int nodes = 30;
  const MembraneLaws laws = make_membrane_laws(parameters(turning));
  const RingMesh mesh = make_ring_mesh(test::dented_polygon(nodes, 1, 0, 0), NaturalShape::outline);
  for (const auto* version : test::kernel_versions<TypeParam>()) {
    const auto after = [&](std::size_t mine, double roughness) {
      KernelBlock<TypeParam> block(mesh, laws, 0.1);
      for (std::size_t lane = 0; lane < block.width; ++lane) {
        block.set(lane, test::dented_polygon(nodes, lane, 0.1, roughness));
      }
      block.set(mine, test::dented_polygon(nodes, 99, 0.1, 0.05));
      version->implicit_step[kernel_index({})](block.arguments());
      return block.get(mine);
    };
    EXPECT_EQ(after(2, 0.0), after(2, 0.4)) << version->name;
    EXPECT_EQ(after(2, 0.0), after(7, 0.0)) << version->name;
  }
}

// The step reports the extremes of its segments and its longest displacement against the flow, the
// area its result.
TYPED_TEST(BlockImplicitKernel, reports_what_the_watch_needs) {
  constexpr int nodes = 30;
  const MembraneLaws laws = make_membrane_laws(parameters(turning));
  const Polygon outline = test::dented_polygon(nodes, 1, 0.1, 0.02);
  const RingMesh mesh = make_ring_mesh(outline, NaturalShape::outline);
  for (const auto* version : test::kernel_versions<TypeParam>()) {
    for (const bool implicit : {true, false}) {
      KernelBlock<TypeParam> block(mesh, laws, implicit ? 0.1 : 1e-3);
      for (std::size_t lane = 0; lane < block.width; ++lane) {
        block.set(lane, test::dented_polygon(nodes, 20 + lane));
      }
      test::disturb(block, {}, 0.01, 7);
      const Polygon before = block.get(5);
      (implicit ? version->implicit_step
                : version->explicit_step)[kernel_index({})](block.arguments());
      const Polygon after = block.get(5);
      double longest = 1;
      double shortest = 1;
      double move = 0;
      double twice = 0;
      for (std::size_t i = 0; i < nodes; ++i) {
        const std::size_t j = (i + 1) % nodes;
        const double ratio = (before[j] - before[i]).norm() / mesh.rest_length[i];
        longest = std::max(longest, ratio);
        shortest = std::min(shortest, ratio);
        const Vector<2> flow = block.flow_at(5, before[i].x() / um, before[i].y() / um);
        move = std::max(move, ((after[i] - before[i]) / um - flow).norm());
        twice += after[i].x() * after[j].y() - after[j].x() * after[i].y();
      }
      const auto row = [&](std::size_t k) {
        return static_cast<double>(block.extremes[k * block.width + 5]);
      };
      EXPECT_NEAR(row(0) * longest, 1, 1e-5);
      EXPECT_NEAR(row(1) * shortest, 1, 1e-5);
      EXPECT_NEAR(std::sqrt(row(2)) / move, 1, 1e-4);
      EXPECT_NEAR(static_cast<double>(block.area[5]) * um * um / (0.5 * twice), 1, 1e-5);
    }
  }
}

}  // namespace
}  // namespace hemoscale::micro
