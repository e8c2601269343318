#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "micro/ensemble/observables/observer.hpp"
#include "micro/error.hpp"
#include "tests/support/micro/ensemble_observables.hpp"

namespace hemoscale::micro {
namespace {

using testing::DoubleNear;
using testing::Each;
using testing::Pointwise;

const Box channel{.length = 12, .height = 10, .walls = true};
const EnsembleState cells =
    test::ellipses({{{4, 3}, 2, 1, 0.3}, {{10, 5}, 2, 0.7, 1.2}, {{6, 8}, 1.5, 1, -0.4}}, 30);

ObservedKind kind() {
  return {.name = "red cells",
          .rest_area = 6,
          .rest_perimeter = 10,
          .node_drag = 0.5,
          .law = test::no_contacts()};
}

ObserverOptions options(std::size_t bins) {
  ObserverOptions options;
  options.bins = bins;
  options.distance_bins = 5;
  options.column_width = 1;
  options.sections = {{"seam", {0, 0}, {0, 10}}};
  options.period = 12;
  return options;
}

TEST(EnsembleObserver, sees_cells_that_a_plug_flow_carries) {
  EnsembleObserver observer(kind(), options(20));
  const EnsembleSample& seen = observer.sample(cells, channel, test::uniform_flow(2), {});
  ASSERT_TRUE(seen.lateral.has_value());
  EXPECT_EQ(seen.cells, 3U);
  EXPECT_NEAR(seen.speed, 2, 1e-13);
  EXPECT_NEAR(seen.lateral->hematocrits.fahraeus(), 1, 1e-13);
  EXPECT_NEAR(seen.area_fraction, seen.lateral->hematocrits.tube, 1e-14);
  EXPECT_EQ(seen.lateral->balance.nodes.total(), 0);
  const LateralProfiles profiles = observer.average().profiles();
  EXPECT_THAT(profiles.flow_velocity, Each(DoubleNear(2, 1e-13)));
  for (std::size_t b = 0; b < profiles.y.size(); ++b) {
    if (profiles.area_fraction[b] > 0) {
      EXPECT_NEAR(profiles.cell_velocity[b], 2, 1e-10);
      EXPECT_NEAR(profiles.area_flux[b], 2 * profiles.area_fraction[b], 1e-12);
    } else {
      EXPECT_TRUE(std::isnan(profiles.cell_velocity[b]));
    }
  }
}

TEST(EnsembleObserver, moves_nodes_by_forces_over_drag) {
  const std::vector<double> push_x(cells.x.size(), 1.5);
  const std::vector<double> push_y(cells.x.size(), -0.5);
  ObservedNodes nodes;
  nodes.forces.lift = {push_x, push_y};
  EnsembleObserver observer(kind(), options(20));
  observer.sample(cells, channel, test::uniform_flow(2), nodes);
  for (const CellRecord& cell : observer.cells()) {
    EXPECT_NEAR(cell.motion.velocity.x(), 2 + 1.5 / 0.5, 1e-13);
    EXPECT_NEAR(cell.motion.velocity.y(), -1, 1e-13);
  }
  // Given velocities take precedence.
  const std::vector<double> fast(cells.x.size(), 7.0);
  nodes.velocity_x = fast;
  nodes.velocity_y = push_y;
  observer.sample(cells, channel, test::uniform_flow(2), nodes);
  EXPECT_NEAR(observer.cells()[0].motion.velocity.x(), 7, 1e-13);
}

TEST(EnsembleObserver, measures_strains_against_the_shape_at_rest) {
  EnsembleObserver observer(kind(), options(20));
  const EnsembleSample& seen = observer.sample(cells, channel, test::uniform_flow(2), {});
  double largest = 0;
  for (const CellShape& shape : measure_cells(cells)) {
    largest = std::max(largest, std::abs(shape.area / 6 - 1));
  }
  EXPECT_NEAR(seen.largest_area_strain, largest, 1e-14);
  EXPECT_GE(seen.largest_area_strain, seen.mean_area_strain);
}

TEST(EnsembleObserver, has_no_profiles_where_the_channel_is_not_straight) {
  ObserverOptions crooked = options(20);
  crooked.is_straight = false;
  EnsembleObserver observer(kind(), crooked);
  EXPECT_FALSE(observer.sample(cells, channel, test::uniform_flow(2), {}).lateral.has_value());
  EXPECT_EQ(observer.average().samples(), 0);
  EXPECT_THROW(observer.average().profiles(), ParameterError);
}

TEST(EnsembleObserver, refuses_what_it_cannot_measure_by) {
  EXPECT_THROW(EnsembleObserver(kind(), options(1)), ParameterError);
  ObserverOptions flat = options(20);
  flat.column_width = 0;
  EXPECT_THROW(EnsembleObserver(kind(), flat), ParameterError);
  ObservedKind unknown = kind();
  unknown.rest_area = 0;
  EXPECT_THROW(EnsembleObserver(unknown, options(20)), ParameterError);
}

TEST(EnsembleObserver, sees_an_empty_channel) {
  EnsembleState none;
  none.nodes = 30;
  EnsembleObserver observer(kind(), options(20));
  const EnsembleSample& seen = observer.sample(none, channel, test::uniform_flow(2), {});
  EXPECT_EQ(seen.cells, 0U);
  EXPECT_FALSE(seen.lateral.has_value());
  // It counts in the averages: half of the samples show the cells.
  observer.sample(cells, channel, test::uniform_flow(2), {});
  EnsembleObserver single(kind(), options(20));
  single.sample(cells, channel, test::uniform_flow(2), {});
  const LateralProfiles both = observer.average().profiles();
  const LateralProfiles one = single.average().profiles();
  EXPECT_NEAR(both.area_fraction[7], 0.5 * one.area_fraction[7], 1e-14);
  EXPECT_GT(both.area_fraction[7], 0);
  EXPECT_NEAR(both.flow_velocity[7], 2, 1e-14);
}

EnsembleState later(EnsembleState state, double time) {
  state.time = time;
  for (double& x : state.x) x += 2 * time;
  return state;
}

TEST(EnsembleObserver, averages_from_the_given_time) {
  ObserverOptions late = options(20);
  late.average_from = 1.5;
  EnsembleObserver observer(kind(), late);
  for (const double time : {0.0, 1.0, 2.0, 3.0}) {
    observer.sample(later(cells, time), channel, test::uniform_flow(2), {});
  }
  EXPECT_EQ(observer.average().samples(), 2);
}

TEST(EnsembleObserver, continues_from_its_snapshot_with_the_same_bits) {
  const test::PlainFlow flow = test::parabolic_flow(10, 3);
  EnsembleObserver whole(kind(), options(20));
  EnsembleObserver first(kind(), options(20));
  EnsembleObserver second(kind(), options(20));
  for (const double time : {0.0, 1.0}) {
    whole.sample(later(cells, time), channel, flow, {});
    first.sample(later(cells, time), channel, flow, {});
  }
  second.restore(first.snapshot());
  for (const double time : {2.0, 3.0}) {
    whole.sample(later(cells, time), channel, flow, {});
    second.sample(later(cells, time), channel, flow, {});
  }
  EXPECT_EQ(second.snapshot().reals, whole.snapshot().reals);
  EXPECT_EQ(second.snapshot().integers, whole.snapshot().integers);
  EXPECT_GT(whole.last().passages[0].cells, 0);
  EnsembleObserver other(kind(), options(10));
  EXPECT_THROW(other.restore(first.snapshot()), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
