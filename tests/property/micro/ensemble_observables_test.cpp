#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "micro/ensemble/observables/observer.hpp"
#include "micro/ensemble/pair_forces.hpp"
#include "tests/support/micro/ensemble_observables.hpp"
#include "tests/support/micro/ensembles.hpp"

namespace hemoscale::micro {
namespace {

using testing::DoubleNear;
using testing::Pointwise;

/// A packed channel, moved for a while: cells of any orientation that touch.
struct Channel {
  EnsembleParameters parameters;
  EnsembleSystem system;
  Box box;
  EnsembleState state;

  Channel() : parameters(test::small_ensemble()) {
    parameters.cells = 8;
    parameters.hematocrit = 0.4;
    parameters.wall.range = 1.5e-6;
    parameters.domain = PlaneChannel{.height = 16e-6};
    EnsembleModel model(parameters, 5);
    model.advance_by(test::poiseuille(16e-6, 2e-3, 0.4), 0.01);
    system = test::system_of(parameters);
    box = test::box_of(model);
    state = test::state_of(model, parameters);
  }
};

const Channel& channel() {
  static const Channel made;
  return made;
}

/// All numbers of a sample and of its profiles, without those that name cells.
struct Seen {
  std::vector<double> series, profiles;
};

Seen look(const EnsembleState& state) {
  const Channel& c = channel();
  ObserverOptions options;
  options.bins = 16;
  // Columns that divide the length, so that a shift by some of them gives the same columns.
  options.column_width = c.box.length / 20;
  EnsembleObserver observer(test::kind_of(c.system), options);
  const ReferenceForces forces = reference_forces(state, c.box, c.system);
  ObservedNodes nodes;
  nodes.forces.membrane = forces.membrane.view();
  nodes.forces.wall = forces.wall.view();
  const EnsembleSample& s =
      observer.sample(state, c.box, test::parabolic_flow(c.box.height, 2e-3), nodes);
  const LateralSample& l = s.lateral.value();
  const MomentRate& rate = l.balance.cells;
  Seen seen;
  // Scaled to the order of one.
  seen.series = {s.area_fraction,
                 s.speed * 1e3,
                 s.orientation.order,
                 s.orientation.angle,
                 s.deformation,
                 s.largest_area_strain,
                 s.largest_perimeter_strain,
                 static_cast<double>(s.contacts.pairs_within_cutoff),
                 static_cast<double>(s.contacts.pairs_within_rest),
                 static_cast<double>(s.contacts.cells_in_contact),
                 s.contacts.coordination,
                 s.contacts.closest * 1e6,
                 l.moments.mean_distance,
                 l.moments.width,
                 l.moments.core_fraction,
                 l.hematocrits.discharge,
                 l.envelope.value().mean() * 1e6,
                 l.half_core_distance.value() * 1e6,
                 l.shear_stress,
                 l.normal_stress,
                 rate.attraction * 1e12,
                 rate.repulsion * 1e12,
                 rate.wall * 1e12,
                 l.balance.nodes.membrane * 1e12};
  const LateralProfiles p = observer.average().profiles();
  for (const auto* values : {&p.area_fraction, &p.along_flow, &p.shear_stress}) {
    for (const double value : *values) seen.profiles.push_back(std::isnan(value) ? -1 : value);
  }
  for (const double value : p.area_flux) seen.profiles.push_back(value * 1e3);
  return seen;
}

void expect_same(const Seen& a, const Seen& b, double tolerance) {
  EXPECT_THAT(a.series, Pointwise(DoubleNear(tolerance), b.series));
  EXPECT_THAT(a.profiles, Pointwise(DoubleNear(tolerance), b.profiles));
}

TEST(EnsembleObservables, do_not_see_where_the_seam_is) {
  const Channel& c = channel();
  const Seen before = look(c.state);
  for (const int columns : {3, 11, 17}) {
    EnsembleState moved = c.state;
    for (std::size_t cell = 0; cell < moved.cells; ++cell) {
      const auto first = static_cast<std::ptrdiff_t>(cell * moved.nodes);
      // Whole cells come back into the box at different moments.
      const double shift = c.box.length * columns / 20;
      const double home = moved.x[cell * moved.nodes] + shift > c.box.length ? c.box.length : 0;
      for (auto x = moved.x.begin() + first;
           x != moved.x.begin() + first + static_cast<std::ptrdiff_t>(moved.nodes); ++x) {
        *x += shift - home;
      }
    }
    expect_same(look(moved), before, 1e-7);
  }
}

TEST(EnsembleObservables, do_not_see_the_numbers_of_the_cells) {
  const Channel& c = channel();
  EnsembleState other = c.state;
  for (std::size_t cell = 0; cell < other.cells; ++cell) {
    const std::size_t from = (5 * cell + 3) % other.cells;
    for (std::size_t k = 0; k < other.nodes; ++k) {
      other.x[cell * other.nodes + k] = c.state.x[from * other.nodes + k];
      other.y[cell * other.nodes + k] = c.state.y[from * other.nodes + k];
    }
  }
  expect_same(look(other), look(c.state), 1e-9);
}

// Mirrored at the axis, the nodes in the other order so that rings stay counter-clockwise; node 0
// lies on the long axis of the outline and stays the first.
TEST(EnsembleObservables, see_the_same_in_the_mirrored_channel) {
  const Channel& c = channel();
  EnsembleState mirrored = c.state;
  for (std::size_t i = 0; i < c.state.x.size(); ++i) {
    const std::size_t first = i / c.state.nodes * c.state.nodes;
    const std::size_t from = i == first ? first : 2 * first + c.state.nodes - i;
    mirrored.x[i] = c.state.x[from];
    mirrored.y[i] = c.box.height - c.state.y[from];
  }
  const Seen before = look(c.state);
  EXPECT_NE(before.series[3], 0);   // the angle, and
  EXPECT_NE(before.series[18], 0);  // the shear stress, which both change sign across the axis
  EXPECT_THAT(look(mirrored).series, Pointwise(DoubleNear(1e-7), before.series));
}

// The mean over planes is Batchelor's stress of membranes and contacts; shear stresses through
// planes along x and along y agree, as there are no torques.
TEST(EnsembleObservables, mean_over_planes_is_the_batchelor_stress) {
  const Channel& c = channel();
  NeighbourList list;
  list.build(c.state, c.box, std::sqrt(c.system.contact.cutoff_squared));
  const ImageTable images(c.box, 0);
  Tensor<2> virial = sum_pairs(c.state, list, images, c.system.contact, 0, c.state.x.size()).virial;
  const ReferenceForces forces = reference_forces(c.state, c.box, c.system);
  for (std::size_t i = 0; i < c.state.x.size(); ++i) {
    const std::size_t first = i / c.state.nodes * c.state.nodes;
    virial +=
        Vector<2>(forces.membrane.x[i], forces.membrane.y[i]) *
        Vector<2>(c.state.x[i] - c.state.x[first], c.state.y[i] - c.state.y[first]).transpose();
  }
  const Tensor<2> batchelor = -virial / c.box.area();
  EnsembleObserver observer(test::kind_of(c.system), {.bins = 13});
  ObservedNodes nodes;
  nodes.forces.membrane = forces.membrane.view();
  observer.sample(c.state, c.box, test::uniform_flow(1), nodes);
  const LateralProfiles p = observer.average().profiles();
  double shear = 0;
  double normal = 0;
  for (std::size_t b = 0; b < p.y.size(); ++b) {
    shear += p.shear_stress[b] / 13;
    normal += p.normal_stress[b] / 13;
  }
  const double scale = batchelor.cwiseAbs().maxCoeff();
  EXPECT_GT(scale, 1e-3);
  EXPECT_NEAR(shear, batchelor(0, 1), 1e-10 * scale);
  EXPECT_NEAR(normal, batchelor(1, 1), 1e-10 * scale);
  EXPECT_NEAR(batchelor(0, 1), batchelor(1, 0), 1e-10 * scale);
}

}  // namespace
}  // namespace hemoscale::micro
