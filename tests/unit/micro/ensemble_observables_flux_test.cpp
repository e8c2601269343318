#include <gtest/gtest.h>

#include "micro/ensemble/observables/cell_flux.hpp"
#include "micro/ensemble/observables/passages.hpp"
#include "micro/error.hpp"
#include "tests/support/micro/ensemble_observables.hpp"

namespace hemoscale::micro {
namespace {

using test::ellipses;

/// Velocities of all nodes in a flow that carries them.
struct Carried {
  std::vector<double> x, y;

  template <class Law>
  Carried(const EnsembleState& state, const Law& law) {
    for (std::size_t i = 0; i < state.x.size(); ++i) {
      const Vector<2> v = law(state.x[i], state.y[i]);
      x.push_back(v.x());
      y.push_back(v.y());
    }
  }
};

const EnsembleState three =
    ellipses({{{4, 3}, 2, 1, 0.3}, {{9, 5}, 2, 0.7, 1.2}, {{6, 7.5}, 1.5, 1, -0.4}}, 30);
const Box channel{.length = 12, .height = 10, .walls = true};

TEST(Hematocrits, of_cells_that_translate_together_are_exact) {
  const auto shapes = measure_cells(three);
  const Carried nodes(three, [](double, double) { return Vector<2>(3, 0); });
  const auto motions = cell_motions(three, shapes, nodes.x, nodes.y);
  const double area = shapes[0].area + shapes[1].area + shapes[2].area;
  const double rate = flow_rate(test::parabolic_flow(10, 4), 0, 10, 0, 4);
  EXPECT_NEAR(rate, 4 * 10 * 2.0 / 3, 1e-12);
  const Hematocrits found = hematocrits(shapes, motions, channel, rate);
  EXPECT_NEAR(found.tube, area / 120, 1e-14);
  EXPECT_NEAR(found.discharge, area / 12 * 3 / (80.0 / 3), 1e-14);
  EXPECT_NEAR(found.mean_velocity, 3, 1e-14);
  EXPECT_NEAR(found.fahraeus(), (80.0 / 3) / (3 * 10), 1e-13);
}

TEST(Hematocrits, agree_for_cells_as_fast_as_a_plug_flow) {
  const auto shapes = measure_cells(three);
  const Carried nodes(three, [](double, double) { return Vector<2>(2, 0); });
  const auto motions = cell_motions(three, shapes, nodes.x, nodes.y);
  const double rate = flow_rate(test::uniform_flow(2), 0, 10, 0);
  EXPECT_NEAR(hematocrits(shapes, motions, channel, rate).fahraeus(), 1, 1e-13);
}

TEST(CellMotion, of_a_linear_flow_is_exact) {
  const auto shapes = measure_cells(three);
  const Carried nodes(three,
                      [](double x, double y) { return Vector<2>(1 + 2 * y - x, 0.5 * x + y); });
  const auto motions = cell_motions(three, shapes, nodes.x, nodes.y);
  for (std::size_t c = 0; c < 3; ++c) {
    const Vector<2>& x = shapes[c].centre;
    EXPECT_NEAR(motions[c].velocity.x(), 1 + 2 * x.y() - x.x(), 1e-12);
    EXPECT_NEAR(motions[c].velocity.y(), 0.5 * x.x() + x.y(), 1e-12);
    EXPECT_NEAR(motions[c].gradient(0, 1), 2, 1e-12);
    EXPECT_NEAR(motions[c].gradient(1, 0), 0.5, 1e-12);
  }
}

TEST(CellMotion, is_that_of_the_centroid_where_nodes_are_crowded) {
  EnsembleState state;
  state.cells = 1;
  state.nodes = 5;
  state.x = {0, 4, 4, 2, 0};
  state.y = {0, 0, 2, 2, 2};
  const Carried nodes(state, [](double, double y) { return Vector<2>(3 * y, 0); });
  const auto motions = cell_motions(state, measure_cells(state), nodes.x, nodes.y);
  EXPECT_NEAR(motions[0].velocity.x(), 3, 1e-13);  // the mean of the nodes is at y = 1.2
}

// Cells that lean with the shear have the same angle on both sides of the axis.
TEST(LateralSums, mirror_the_inclination_above_the_axis) {
  const EnsembleState state = ellipses({{{4, 3}, 2, 1, 0.3}, {{9, 7}, 2, 1, -0.3}}, 30);
  const auto shapes = measure_cells(state);
  const LateralSums sums =
      lateral_sums(state, shapes, std::vector<CellMotion>(2), {.height = 10, .count = 2});
  for (std::size_t b = 0; b < 2; ++b) {
    EXPECT_NEAR(0.5 * std::atan2(sums.sine[b], sums.cosine[b]), 0.3, 1e-10);
    EXPECT_NEAR(std::hypot(sums.sine[b], sums.cosine[b]), sums.area[b], 1e-10);
  }
}

// The velocity inside a cell varies as its nodes say, so that a bin sees the velocity at its own
// height.
TEST(LateralSums, resolve_the_velocity_inside_the_cells) {
  // A rectangle from y = 1 to y = 5, sheared: u = y.
  const EnsembleState state = test::rectangles({{2, 1}}, 3, 4);
  const auto shapes = measure_cells(state);
  const Carried nodes(state, [](double, double y) { return Vector<2>(y, 0); });
  const LateralSums sums = lateral_sums(
      state, shapes, cell_motions(state, shapes, nodes.x, nodes.y), {.height = 6, .count = 6});
  EXPECT_NEAR(sums.area[0], 0, 1e-14);
  for (std::size_t b = 1; b < 5; ++b) {
    EXPECT_NEAR(sums.area[b], 3, 1e-13);
    EXPECT_NEAR(sums.transport[b] / sums.area[b], static_cast<double>(b) + 0.5, 1e-13);
  }
}

TEST(LateralSums, of_the_transport_add_up_to_the_flux_of_the_cells) {
  const auto shapes = measure_cells(three);
  const Carried nodes(three, [](double x, double y) { return Vector<2>(y * y - 0.1 * x, x); });
  const auto motions = cell_motions(three, shapes, nodes.x, nodes.y);
  const LateralSums sums = lateral_sums(three, shapes, motions, {.height = 10, .count = 17});
  double transport = 0;
  for (const double part : sums.transport) transport += part;
  const Hematocrits found = hematocrits(shapes, motions, channel, 1);
  EXPECT_NEAR(transport / 12, found.discharge, 1e-12 * found.discharge);
}

TEST(PassageCounter, counts_cells_and_their_area_through_openings) {
  PassageCounter counter({{"lower", {10, 0}, {10, 5}}, {"upper", {10, 5}, {10, 10}}}, 0);
  const auto at = [&](double x, double y) {
    return measure_cells(ellipses({{{x, y}, 1, 1, 0}, {{x, 9}, 2, 1, 0}}, 20));
  };
  const std::vector<std::int64_t> identities = {7, 3};
  counter.update(identities, at(9, 2));
  EXPECT_EQ(counter.passages()[0].cells, 0);
  counter.update(identities, at(11, 3));
  EXPECT_EQ(counter.passages()[0].cells, 1);
  EXPECT_EQ(counter.passages()[1].cells, 1);
  EXPECT_NEAR(counter.passages()[0].area, test::polygon_area({{0, 0}, 1, 1, 0}, 20), 1e-12);
  EXPECT_NEAR(counter.passages()[1].area, test::polygon_area({{0, 0}, 2, 1, 0}, 20), 1e-12);
  // Back again: nothing has passed.
  counter.update(identities, at(9.5, 3));
  EXPECT_EQ(counter.passages()[0].cells, 0);
  EXPECT_NEAR(counter.passages()[0].area, 0, 1e-12);
}

TEST(PassageCounter, does_not_count_cells_that_appear_beyond) {
  PassageCounter counter({{"end", {10, 0}, {10, 10}}}, 0);
  counter.update(std::vector<std::int64_t>{1}, measure_cells(ellipses({{{9, 5}, 1, 1, 0}}, 20)));
  counter.update(std::vector<std::int64_t>{2}, measure_cells(ellipses({{{11, 5}, 1, 1, 0}}, 20)));
  EXPECT_EQ(counter.passages()[0].cells, 0);
}

TEST(PassageCounter, counts_every_round_through_a_periodic_channel_once) {
  PassageCounter counter({{"seam", {0, 0}, {0, 10}}}, 12);
  for (int k = 0; k <= 30; ++k) {
    const double x = std::fmod(2.5 + 4.0 * k, 12);  // ten rounds
    counter.update(std::vector<std::int64_t>{0}, measure_cells(ellipses({{{x, 5}, 1, 1, 0}}, 20)));
  }
  EXPECT_EQ(counter.passages()[0].cells, 10);
}

TEST(PassageCounter, continues_from_its_snapshot) {
  const std::vector<CountedSection> sections = {{"end", {10, 0}, {10, 10}}};
  PassageCounter first(sections, 0);
  const std::vector<std::int64_t> one = {5};
  first.update(one, measure_cells(ellipses({{{9, 5}, 1, 1, 0}}, 20)));
  Snapshot snapshot;
  first.store(snapshot);
  PassageCounter second(sections, 0);
  second.load(snapshot);
  second.update(one, measure_cells(ellipses({{{11, 5}, 1, 1, 0}}, 20)));
  EXPECT_EQ(second.passages()[0].cells, 1);
  PassageCounter other({}, 0);
  EXPECT_THROW(other.load(snapshot), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
