#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "micro/error.hpp"
#include "tests/support/micro/block_laws.hpp"

// The limits of blocks/block_limits.hpp from both sides.
namespace hemoscale::micro {
namespace {

using blocks::block_limit;
using test::BlockCase;
using test::Integrator;
using testing::HasSubstr;

struct LimitCase {
  const char* name;
  Integrator integrator;
  int nodes = 40;
  int stages = 10;
  double mass_time = 0;    // [s] m / zeta
  double normal_drag = 1;  // [-]
};

void PrintTo(const LimitCase& c, std::ostream* out) {
  *out << c.name;
}

class BlockLimits : public testing::TestWithParam<LimitCase> {
 protected:
  /// Contacts and walls do not act on a lonely cell: the limit is that of the membrane.
  static BlockCase disturbed(double share) {
    const LimitCase& p = GetParam();
    BlockCase c = test::disturbed_cell(p.nodes);
    auto& kind = c.settings.kinds.front();
    PairPotential none = test::vessel_contact();
    none.scale = 0;
    c.settings.contact = none;
    c.settings.integrator = p.integrator;
    c.settings.stages = p.stages;
    kind.node_mass = p.mass_time * kind.node_drag;
    kind.normal_drag = p.normal_drag;
    c.settings.time_step = share * block_limit(c.settings).time_step;
    c.settings.force = share > 1;
    return c;
  }
};

TEST_P(BlockLimits, below_a_disturbance_dies_out) {
  BlockEnsemble ensemble = disturbed(0.9).make(Precision::twofold);
  const double first = test::motion(ensemble, 0);
  EXPECT_LT(test::motion(ensemble, 4000), 0.02 * first);
}

TEST_P(BlockLimits, above_a_run_is_refused) {
  BlockCase c = disturbed(1.01);
  c.settings.force = false;
  try {
    c.make(Precision::twofold);
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_THAT(error.what(), HasSubstr("exceeds"));
    EXPECT_THAT(error.what(), HasSubstr("stiffness of membrane"));
    EXPECT_THAT(error.what(), HasSubstr("reduce the time step"));
  }
  EXPECT_THROW(require_step(c.settings, false), ParameterError);
  EXPECT_NO_THROW(require_step(c.settings, true));
}

// Stretching tears the ring; zigzags of bending may stop growing where they are no longer small.
TEST_P(BlockLimits, above_a_forced_run_ends_with_the_diagnosis_or_does_not_come_to_rest) {
  BlockEnsemble ensemble = disturbed(1.1).make(Precision::twofold);
  const double first = test::motion(ensemble, 0);
  try {
    EXPECT_GT(test::motion(ensemble, 20000), 10 * first);
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("step "));
    EXPECT_THAT(error.what(), HasSubstr("time step"));
    EXPECT_THAT(error.what(), HasSubstr("reduce"));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Integrators, BlockLimits,
    testing::Values(
        LimitCase{.name = "explicit_stretching", .integrator = Integrator::explicit_euler},
        LimitCase{
            .name = "explicit_bending", .integrator = Integrator::explicit_euler, .nodes = 100},
        LimitCase{.name = "explicit_anisotropic",
                  .integrator = Integrator::explicit_euler,
                  .nodes = 100,
                  .normal_drag = 0.4},
        LimitCase{.name = "light_nodes", .integrator = Integrator::inertial, .mass_time = 1e-7},
        LimitCase{.name = "heavy_nodes", .integrator = Integrator::inertial, .mass_time = 1e-4},
        LimitCase{.name = "two_stages", .integrator = Integrator::chebyshev, .stages = 2},
        LimitCase{.name = "six_stages", .integrator = Integrator::chebyshev, .stages = 6},
        LimitCase{.name = "twenty_stages",
                  .integrator = Integrator::chebyshev,
                  .nodes = 100,
                  .stages = 20}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(BlockLimit, of_nodes_with_mass_has_both_limits) {
  BlockCase c = test::disturbed_cell(40);
  auto& kind = c.settings.kinds.front();
  const double overdamped = [&] {
    c.settings.integrator = Integrator::explicit_euler;
    return block_limit(c.settings).time_step;
  }();
  c.settings.integrator = Integrator::inertial;
  kind.node_mass = 1e-12 * kind.node_drag;
  EXPECT_NEAR(block_limit(c.settings).time_step, overdamped, 1e-6 * overdamped);
  kind.node_mass = 10 * kind.node_drag;
  const auto limit = block_limit(c.settings);
  const double stiffness = limit.ring + limit.contact + limit.wall;
  EXPECT_NEAR(limit.time_step, 2 * std::sqrt(kind.node_mass / stiffness), 1e-3 * limit.time_step);
}

/// A cell held between two walls that it feels all the time; walls much stiffer than its membrane.
BlockCase squeezed(double share) {
  BlockCase c = test::disturbed_cell(40, 1e-9);
  c.settings.integrator = Integrator::explicit_euler;
  PairPotential none = test::vessel_contact();
  none.scale = 0;
  c.settings.contact = none;
  double lowest = 1;
  double highest = 0;
  for (const double y : c.initial.front().y) {
    lowest = std::min(lowest, y);
    highest = std::max(highest, y);
  }
  c.settings.height = highest - lowest + 0.2e-6;
  c.settings.plane_walls = WallPotential{.stiffness = 2000, .range = 0.3e-6};
  for (double& y : c.initial.front().y) y -= lowest - 0.1e-6;
  c.settings.time_step = share * block_limit(c.settings).time_step;
  c.settings.force = share > 1;
  return c;
}

/// Cosine between the displacements of all nodes in two consecutive steps, after many: 1 for a
/// motion that dies out, negative for one that trembles. A run that fails trembled.
double likeness(const BlockCase& c, std::int64_t steps) {
  BlockEnsemble ensemble = c.make(Precision::twofold);
  try {
    ensemble.advance(steps);
    const EnsembleState first = ensemble.states().front();
    ensemble.advance(1);
    const EnsembleState second = ensemble.states().front();
    ensemble.advance(1);
    const EnsembleState third = ensemble.states().front();
    double product = 0;
    double before = 0;
    double after = 0;
    for (std::size_t i = 0; i < first.x.size(); ++i) {
      const Vector<2> a(second.x[i] - first.x[i], second.y[i] - first.y[i]);
      const Vector<2> b(third.x[i] - second.x[i], third.y[i] - second.y[i]);
      product += a.dot(b);
      before += a.squaredNorm();
      after += b.squaredNorm();
    }
    return product / std::sqrt(before * after);
  } catch (const NumericalError&) {
    return -1;
  }
}

// Nodes that leave the range of a wall feel none of it: above the limit they tremble.
TEST(BlockWallLimit, decides_whether_a_squeezed_cell_trembles) {
  EXPECT_GT(likeness(squeezed(0.95), 3000), 0.9);
  EXPECT_LT(likeness(squeezed(1.1), 3000), -0.5);
}

TEST(BlockWallLimit, is_that_of_the_stiffness_of_walls) {
  BlockCase c = squeezed(1);
  const double limit = block_limit(c.settings).time_step;
  EXPECT_NEAR(limit, 2 * c.settings.kinds.front().node_drag / 2000, 0.05 * limit);
}

// Implicit integrators: the exact stiffness of walls calms any step; the constant operator trembles
// where nodes leave the range of a wall that is too stiff for the step.
TEST(BlockWallLimit, of_implicit_integrators) {
  for (const double step : {1e-3, 5e-3}) {
    BlockCase c = squeezed(1);
    c.settings.integrator = Integrator::linearly_implicit;
    c.settings.time_step = step;
    BlockEnsemble ensemble = c.make(Precision::twofold);
    const double first = test::motion(ensemble, 2);
    EXPECT_LT(test::motion(ensemble, 500), 0.01 * first) << step;
  }
  for (const Integrator integrator :
       {Integrator::constant_operator, Integrator::constant_operator_second_order}) {
    BlockCase c = squeezed(1);
    c.settings.integrator = integrator;
    c.settings.time_step = 2e-3;
    EXPECT_THROW(c.make(Precision::twofold), ParameterError);
    c.settings.force = true;
    EXPECT_LT(likeness(c, 500), 0);
    c.settings.plane_walls->stiffness = 1;
    c.settings.force = false;
    c.settings.time_step = 0.95 * block_limit(c.settings).time_step;
    BlockEnsemble ensemble = c.make(Precision::twofold);
    const double first = test::motion(ensemble, 2);
    EXPECT_LT(test::motion(ensemble, 500), 1e-3 * first) << c.settings.time_step;
  }
}

/// Two cells pressed onto each other by walls, with contacts much stiffer than all else.
BlockCase pressed(Integrator integrator, double share) {
  BlockCase c = test::disturbed_cell(40, 1e-9);
  c.settings.integrator = integrator;
  c.settings.stages = 30;
  PairPotential stiff = test::vessel_contact();
  stiff.scale *= 100;
  stiff.rest_squared = 0.64e-12;  // wider than the spacing, so that rows of nodes face each other
  stiff.cutoff_squared = 1e-12;
  stiff.attraction = 0;
  c.settings.contact = stiff;
  EnsembleState& state = c.initial.front();
  double lowest = 1;
  double highest = 0;
  for (const double y : state.y) {
    lowest = std::min(lowest, y);
    highest = std::max(highest, y);
  }
  const double pitch = highest - lowest + 0.6e-6;
  for (std::size_t i = 0; i < state.nodes; ++i) {
    state.y[i] -= lowest - 0.2e-6;
    state.x.push_back(state.x[i] + 1e-7);
    state.y.push_back(state.y[i] + pitch);
  }
  state.cells = 2;
  c.settings.height = pitch + highest - lowest + 0.4e-6;
  c.settings.plane_walls = WallPotential{.stiffness = 20, .range = 0.5e-6};
  c.settings.time_step = share * block_limit(c.settings).time_step;
  c.settings.force = share > 1;
  return c;
}

// The limit is for the stiffest distance and for rows of nodes that face each other: it is safe,
// and cells that lie at the rest distance bear some times as much.
TEST(BlockContactLimit, decides_whether_pressed_cells_tremble) {
  EXPECT_GT(likeness(pressed(Integrator::explicit_euler, 0.95), 3000), 0.9);
  EXPECT_LT(likeness(pressed(Integrator::explicit_euler, 8), 3000), -0.5);
  EXPECT_GT(likeness(pressed(Integrator::chebyshev, 0.95), 2000), 0.9);
  EXPECT_LT(likeness(pressed(Integrator::chebyshev, 8), 5000), -0.5);
}

TEST(BlockLimit, of_shear_that_carries_cells_through_contacts_holds_for_all_integrators) {
  for (const Integrator integrator : test::integrators_without_mass) {
    BlockCase c = test::crowded_channel();
    test::set_integrator(c.settings, integrator);
    c.settings.time_step = 0.5;
    EXPECT_THROW(c.make(Precision::single), ParameterError);
  }
  BlockCase c = test::crowded_channel();
  const double limit = block_limit(c.settings).time_step;
  EXPECT_GT(limit, 1e-3);
  EXPECT_LT(limit, 0.1);
}

TEST(BlockSteps, defaults_follow_the_shear_rate) {
  const SimpleShearFlow flow(-0.16, 75e-6);
  EXPECT_DOUBLE_EQ(blocks::default_step(flow), 3e-4 / 0.16);
  EXPECT_EQ(blocks::default_step(test::NoFlow()), std::numeric_limits<double>::infinity());
}

TEST(BlockSteps, nodes_with_mass_need_double_precision_for_short_steps) {
  BlockCase c = test::relaxing_cell();
  c.settings.integrator = Integrator::inertial;
  c.settings.kinds.front().node_mass = 1e-3 * c.settings.kinds.front().node_drag;
  c.settings.time_step = 0.9 * blocks::smallest_single_step(*c.settings.flow);
  EXPECT_NO_THROW(c.make(Precision::twofold));
  try {
    c.make(Precision::single);
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_THAT(error.what(), HasSubstr("choose double precision"));
  }
  c.settings.time_step *= 1.2;
  EXPECT_NO_THROW(c.make(Precision::single));
}

// A cell that is driven through a wall ends its run.
TEST(BlockWatch, ends_runs_of_cells_beyond_a_wall) {
  BlockCase c = test::disturbed_cell(40);
  c.settings.height = 20e-6;
  c.settings.plane_walls = WallPotential{.stiffness = 1e-6, .range = 0.3e-6};
  for (double& y : c.initial.front().y) y -= 4e-6;
  c.settings.time_step = 1e-4;
  BlockEnsemble ensemble = c.make(Precision::single);
  try {
    ensemble.advance(200);
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("beyond a wall"));
  }
}

}  // namespace
}  // namespace hemoscale::micro
