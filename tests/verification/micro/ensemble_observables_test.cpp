#include <gtest/gtest.h>

#include <cmath>

#include "micro/ensemble/observables/observer.hpp"
#include "micro/ensemble/stepper.hpp"
#include "tests/support/micro/ensemble_observables.hpp"
#include "tests/support/micro/ensembles.hpp"

namespace hemoscale::micro {
namespace {

EnsembleParameters channel_parameters() {
  EnsembleParameters p = test::small_ensemble();
  p.cells = 8;
  p.hematocrit = 0.4;
  p.contact.attraction = 0.3;
  p.wall.range = 1.5e-6;
  p.domain = PlaneChannel{.height = 16e-6};
  return p;
}

MomentBalance balance_of(const EnsembleState& state, const Box& box, const EnsembleSystem& system) {
  const PairLaw law = make_pair_law(system.contact);
  NeighbourList list;
  list.build(state, box, law.cutoff);
  const ReferenceForces forces = reference_forces(state, box, system);
  NodeForces parts;
  parts.membrane = forces.membrane.view();
  parts.wall = forces.wall.view();
  return moment_balance(state, {}, pair_parts(state, box, list, law), parts, box.height,
                        system.node_drag);
}

// The sum of the parts, integrated along a run, is the change of the mean square distance that the
// run shows; the rest is the error of Euler's steps, dt^2 <v^2> each.
TEST(MomentBalance, predicts_what_the_explicit_model_does_to_one_percent) {
  const EnsembleParameters p = channel_parameters();
  EnsembleModel model(p, 4);
  const EnsembleSystem system = test::system_of(p);
  const Forcing<2> forcing = test::poiseuille(16e-6, 2e-3, 0.4);
  model.advance_by(forcing, 0.01);
  const Box box = test::box_of(model);
  const MomentBalance start = balance_of(test::state_of(model, p), box, system);
  double nodes = 0;
  double cells = 0;
  for (int i = 0; i < 300; ++i) {
    const MomentBalance now = balance_of(test::state_of(model, p), box, system);
    nodes += now.nodes.total() * model.time_step();
    cells += now.cells.total() * model.time_step();
    EXPECT_NEAR(now.cells.membrane, 0, 1e-9 * std::abs(now.cells.repulsion));
    model.advance_by(forcing, model.time_step());
  }
  const MomentBalance end = balance_of(test::state_of(model, p), box, system);
  EXPECT_NE(start.cells.wall, 0);
  EXPECT_NE(start.cells.repulsion, 0);
  EXPECT_NE(start.cells.attraction, 0);
  EXPECT_NEAR(end.node_moment - start.node_moment, nodes, 0.01 * std::abs(nodes));
  EXPECT_NEAR(end.cell_moment - start.cell_moment, cells, 0.01 * std::abs(cells));
}

// The parts are those whose sum moves the nodes in the reference model.
TEST(NodeForces, sum_to_those_of_the_explicit_step) {
  const EnsembleParameters p = channel_parameters();
  EnsembleModel model(p, 2);
  const EnsembleSystem system = test::system_of(p);
  const Box box = test::box_of(model);
  EnsembleState state = test::state_of(model, p);
  const EnsembleState before = state;
  Stepper stepper(system);
  stepper.step(state, box, CubicProfile(*test::poiseuille(16e-6, 2e-3, 0.4).profile));
  const PairLaw law = make_pair_law(system.contact);
  NeighbourList list;
  list.build(before, box, law.cutoff);
  const PairParts pairs = pair_parts(before, box, list, law);
  const ReferenceForces forces = reference_forces(before, box, system);
  double scale = 0;
  for (const double f : stepper.force_y()) scale = std::max(scale, std::abs(f));
  for (std::size_t i = 0; i < before.x.size(); ++i) {
    EXPECT_NEAR(pairs.repulsion.x[i] + pairs.attraction.x[i] + forces.membrane.x[i],
                stepper.force_x()[i], 1e-12 * scale);
    EXPECT_NEAR(
        pairs.repulsion.y[i] + pairs.attraction.y[i] + forces.membrane.y[i] + forces.wall.y[i],
        stepper.force_y()[i], 1e-12 * scale);
  }
}

// The virial of pairs that repel spreads the cells, that of pairs that attract contracts them.
TEST(MomentBalance, repulsion_spreads_and_attraction_contracts) {
  const EnsembleParameters p = channel_parameters();
  EnsembleModel model(p, 4);
  model.advance_by(test::poiseuille(16e-6, 2e-3, 0.4), 0.01);
  const MomentBalance now =
      balance_of(test::state_of(model, p), test::box_of(model), test::system_of(p));
  EXPECT_GT(now.nodes.repulsion, 0);
  EXPECT_LT(now.nodes.attraction, 0);
  EXPECT_LT(now.cells.wall, 0);
}

// The observer agrees with the averages of the reference model, which samples the same states.
TEST(EnsembleObserver, agrees_with_the_profiles_of_the_reference_model) {
  const EnsembleParameters p = channel_parameters();
  EnsembleModel model(p, 2);
  const EnsembleSystem system = test::system_of(p);
  const Forcing<2> forcing = test::poiseuille(16e-6, 2e-3, 0.4);
  model.advance_by(forcing, 0.01);
  const Box box = test::box_of(model);
  const EnsembleState state = test::state_of(model, p);
  const ReferenceForces forces = reference_forces(state, box, system);
  ObservedNodes nodes;
  nodes.forces.membrane = forces.membrane.view();
  nodes.forces.wall = forces.wall.view();
  EnsembleObserver observer(test::kind_of(system), {.bins = 20});
  const EnsembleSample& seen =
      observer.sample(state, box, test::parabolic_flow(16e-6, 2e-3), nodes);
  const LateralProfiles profiles = observer.average().profiles();
  // One step: its sample is taken of the state before.
  const SceneObservation reference = model.advance_by(forcing, model.time_step());
  ASSERT_TRUE(reference.profile.has_value());
  double mean = 0;
  for (std::size_t b = 0; b < 20; ++b) {
    EXPECT_NEAR(profiles.area_fraction[b], reference.profile->area_fraction[b], 1e-12);
    mean += profiles.normal_stress[b] / 20;
    if (profiles.area_fraction[b] > 0.3) {
      EXPECT_NEAR(profiles.cell_velocity[b], reference.profile->cell_velocity[b], 0.1 * 2e-3);
    }
  }
  EXPECT_NEAR(mean, reference.particle_stress(1, 1), 1e-9 * std::abs(mean));
  EXPECT_NEAR(seen.lateral->envelope->mean(), reference.profile->cell_free_layer, 0.2e-6);
}

}  // namespace
}  // namespace hemoscale::micro
