#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "micro/ensemble/observables/cross_forces.hpp"
#include "tests/support/micro/block_laws.hpp"
#include "tests/support/micro/ensemble_observables.hpp"

// Forces between kinds of cells, and forces of a step with more than an isotropic drag.
namespace hemoscale::micro {
namespace {

const Box channel{.length = 12, .height = 10, .walls = true};
const PairLaw law = make_pair_law(make_pair_potential(3, 0.5, 1, 0.2));

/// Red cells and platelets that touch each other, across the seam too; one has left by a period.
std::vector<EnsembleState> two_kinds() {
  EnsembleState red = test::ellipses({{{4, 3}, 2, 1, 0.3}, {{10, 5}, 2, 0.7, 1.2}}, 30);
  EnsembleState small = test::ellipses(
      {{{6.3, 3.9}, 0.6, 0.4, 0}, {{11.9, 6}, 0.9, 0.4, 0.5}, {{1, 9}, 0.5, 0.3, 0}}, 12);
  for (std::size_t i = 12; i < 24; ++i) small.x[i] -= channel.length;
  return {red, small};
}

/// Every node of a kind with every node of the others and their images.
ForceArrays plain_cross_forces(const std::vector<EnsembleState>& kinds, std::size_t kind) {
  ForceArrays forces;
  for (std::size_t i = 0; i < kinds[kind].x.size(); ++i) {
    double fx = 0;
    double fy = 0;
    for (std::size_t other = 0; other < kinds.size(); ++other) {
      if (other == kind) continue;
      for (std::size_t j = 0; j < kinds[other].x.size(); ++j) {
        for (int image = -2; image <= 2; ++image) {
          const double dx = kinds[kind].x[i] - kinds[other].x[j] - image * channel.length;
          const double dy = kinds[kind].y[i] - kinds[other].y[j];
          const double f = law.force_over_distance(dx * dx + dy * dy);
          fx += f * dx;
          fy += f * dy;
        }
      }
    }
    forces.x.push_back(fx);
    forces.y.push_back(fy);
  }
  return forces;
}

TEST(CrossForces, are_those_of_a_plain_double_loop) {
  const std::vector<EnsembleState> kinds = two_kinds();
  const std::vector<ForceArrays> forces = cross_forces(kinds, channel, law);
  ASSERT_EQ(forces.size(), 2U);
  double sum_x = 0;
  double sum_y = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const ForceArrays plain = plain_cross_forces(kinds, k);
    ASSERT_EQ(forces[k].x.size(), plain.x.size());
    double largest = 0;
    for (std::size_t i = 0; i < plain.x.size(); ++i) {
      EXPECT_NEAR(forces[k].x[i], plain.x[i], 1e-13);
      EXPECT_NEAR(forces[k].y[i], plain.y[i], 1e-13);
      largest = std::max(largest, std::abs(plain.x[i]));
      sum_x += forces[k].x[i];
      sum_y += forces[k].y[i];
    }
    EXPECT_GT(largest, 0.05);
  }
  EXPECT_NEAR(sum_x, 0, 1e-13);
  EXPECT_NEAR(sum_y, 0, 1e-13);
}

TEST(CrossForces, of_one_kind_or_of_none_are_zero) {
  const std::vector<EnsembleState> one(1, two_kinds().front());
  const auto alone = cross_forces(one, channel, law);
  for (const double f : alone.front().x) EXPECT_EQ(f, 0);
  EnsembleState nobody;
  nobody.nodes = 12;
  const auto with_nobody =
      cross_forces(std::vector<EnsembleState>{one.front(), nobody}, channel, law);
  EXPECT_TRUE(with_nobody[1].x.empty());
  for (const double f : with_nobody[0].y) EXPECT_EQ(f, 0);
}

/// A red cell and a platelet in contact.
test::BlockCase touching(test::Integrator integrator) {
  test::BlockCase c = test::relaxing_cell();
  c.settings.height = 40e-6;
  c.settings.length = 60e-6;
  c.settings.periodic_y = false;
  c.settings.flow = test::parabola(c.settings.height, 1e-4);
  c.settings.plane_walls = WallPotential{.stiffness = 1, .range = 0.3e-6};
  test::set_integrator(c.settings, integrator);
  blocks::KindSettings small = c.settings.kinds.front();
  OutlineParameters outline;
  outline.outline = Outline::ellipse;
  outline.length = 2.5e-6;
  outline.aspect = 0.4;
  const auto nodes = outline_nodes(outline, 12);
  small.mesh = make_ring_mesh(nodes, NaturalShape::outline);
  c.settings.kinds.push_back(small);
  EnsembleState& red = c.initial.front();
  const double mean = std::accumulate(red.y.begin(), red.y.end(), 0.0) / 32;
  for (double& y : red.y) y += 12e-6 - mean;
  double right = red.x.front();
  double at = red.y.front();
  for (std::size_t i = 0; i < red.x.size(); ++i) {
    if (red.x[i] > right) {
      right = red.x[i];
      at = red.y[i];
    }
  }
  EnsembleState platelet;
  platelet.cells = 1;
  platelet.nodes = 12;
  for (const Vector<2>& x : nodes) {
    platelet.x.push_back(right + 1.4e-6 + x.x());
    platelet.y.push_back(at + x.y());
  }
  c.initial.push_back(platelet);
  return c;
}

// Membranes exert no net force on their cell: what is left of it is that of other kinds, where it
// has not been told apart.
TEST(CrossForces, leave_membranes_without_net_force_in_a_step) {
  test::BlockCase c = touching(test::Integrator::explicit_euler);
  c.settings.time_step = 1e-8;
  BlockEnsemble ensemble = c.make(Precision::twofold);
  const Box box{.length = c.settings.length, .height = c.settings.height, .walls = true};
  const PairLaw contact = make_pair_law(c.settings.contact);
  const std::vector<EnsembleState> before = ensemble.states();
  ensemble.advance(1);
  const std::vector<EnsembleState> after = ensemble.states();
  std::vector<StepForces> steps;
  for (std::size_t k = 0; k < 2; ++k) {
    steps.push_back(step_forces(before[k], after[k], c.settings.time_step, box, *c.settings.flow,
                                c.settings.kinds[k].node_drag, contact, *c.settings.plane_walls));
  }
  const auto net = [](const ForceArrays& forces) {
    Vector<2> sum = Vector<2>::Zero();
    for (std::size_t i = 0; i < forces.x.size(); ++i) sum += Vector<2>(forces.x[i], forces.y[i]);
    return sum;
  };
  const double mixed = net(steps.front().membrane).norm();
  separate_other_kinds(steps, after, box, contact);
  for (const StepForces& step : steps) {
    EXPECT_NEAR(net(step.other_kinds).norm(), mixed, 0.02 * mixed);
    EXPECT_LT(net(step.membrane).norm(), 0.02 * mixed);
  }
  EXPECT_GT(mixed, 1e-9);
}

// The forces of a step with anisotropic drag are those with isotropic drag.
TEST(StepForces, with_anisotropic_drag_are_the_forces_of_the_state) {
  const auto forces_with = [](double ratio) {
    test::BlockCase c = touching(test::Integrator::explicit_euler);
    c.settings.time_step = 1e-8;
    for (blocks::KindSettings& kind : c.settings.kinds) kind.normal_drag = ratio;
    BlockEnsemble ensemble = c.make(Precision::twofold);
    const auto before = ensemble.states();
    ensemble.advance(1);
    const auto after = ensemble.states();
    const Box box{.length = c.settings.length, .height = c.settings.height, .walls = true};
    return step_forces(before[0], after[0], c.settings.time_step, box, *c.settings.flow,
                       c.settings.kinds[0].node_drag, test::no_contacts(), {},
                       {.normal_ratio = ratio});
  };
  const StepForces isotropic = forces_with(1);
  const StepForces anisotropic = forces_with(3);
  double largest = 0;
  for (const double f : isotropic.membrane.x) largest = std::max(largest, std::abs(f));
  for (std::size_t i = 0; i < isotropic.membrane.x.size(); ++i) {
    EXPECT_NEAR(anisotropic.membrane.x[i], isotropic.membrane.x[i], 1e-3 * largest);
    EXPECT_NEAR(anisotropic.membrane.y[i], isotropic.membrane.y[i], 1e-3 * largest);
  }
}

// A law of migration moves cells without a force of the membrane; its share is that of lift.
TEST(StepForces, tell_drift_from_forces) {
  test::BlockCase c = touching(test::Integrator::constant_operator_second_order);
  c.settings.time_step = 1e-5;
  c.settings.migration.wall_lift = WallLift{.coefficient = 1e-16};
  const Box box{.length = c.settings.length, .height = c.settings.height, .walls = true};
  // One kind far from everything.
  c.settings.kinds.pop_back();
  c.initial.pop_back();
  BlockEnsemble ensemble = c.make(Precision::twofold);
  ensemble.advance(100);
  const EnsembleState before = ensemble.states().front();
  ensemble.advance(1);
  const EnsembleState after = ensemble.states().front();
  const double drag = c.settings.kinds.front().node_drag;
  const std::vector<double> drift =
      drift_velocities(before, c.settings.migration, box, *c.settings.flow, c.settings.time_step);
  const StepForces step =
      step_forces(before, after, c.settings.time_step, box, *c.settings.flow, drag,
                  make_pair_law(c.settings.contact), *c.settings.plane_walls, {.drift_y = drift});
  double net = 0;
  double lift = 0;
  for (std::size_t i = 0; i < drift.size(); ++i) {
    net += step.membrane.y[i];
    lift += step.lift.y[i];
    EXPECT_DOUBLE_EQ(step.lift.y[i], drag * drift.front());
  }
  EXPECT_GT(lift, 0);
  EXPECT_LT(std::abs(net), 1e-3 * lift);
}

// The momentum drag is part of what joins velocity to force.
TEST(StepForces, hold_the_momentum_drag) {
  EnsembleState before = test::rectangles({{1, 2}}, 2, 2);
  EnsembleState after = before;
  for (double& x : after.x) x += 0.3;
  const StepForces step = step_forces(before, after, 0.1, channel, test::uniform_flow(1), 0.5,
                                      test::no_contacts(), {}, {.momentum = 2});
  for (const double f : step.membrane.x) EXPECT_NEAR(f, 0.5 * 2 + 2 * 2 * 2, 1e-13);
}

}  // namespace
}  // namespace hemoscale::micro
