#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "micro/ensemble/lateral_profile.hpp"
#include "micro/ensemble/observables/cell_free_layer.hpp"
#include "micro/ensemble/observables/lateral.hpp"
#include "micro/error.hpp"
#include "tests/support/micro/ensemble_observables.hpp"

namespace hemoscale::micro {
namespace {

using test::ellipses;
using test::rectangles;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::Pointwise;

// Two rectangles of 2 x 3 in a channel of 8 x 8, one across the periodic seam.
TEST(AreaFractions, of_rectangles_are_exact) {
  const EnsembleState state = rectangles({{1, 1}, {7, 4}}, 2, 3);
  const std::vector<double> expected = {2.0 / 16, 4.0 / 16, 4.0 / 16, 2.0 / 16};
  EXPECT_THAT(area_fractions(state, 8, {.height = 8, .count = 4}),
              Pointwise(DoubleNear(1e-14), expected));
}

TEST(AreaFractions, agree_with_the_area_below_lines) {
  const EnsembleState state = ellipses({{{3, 4.1}, 2.5, 0.8, 0.7}}, 37);
  const LateralBins bins{.height = 8, .count = 13};
  const std::vector<double> fractions = area_fractions(state, 10, bins);
  double below = 0;
  for (std::size_t b = 0; b < bins.count; ++b) {
    const double line = bins.width() * static_cast<double>(b + 1);
    const double next = area_below(state.x.data(), state.y.data(), state.nodes, line);
    EXPECT_NEAR(fractions[b], (next - below) / (10 * bins.width()), 1e-14);
    below = next;
  }
}

TEST(AreaFractions, give_area_beyond_a_wall_to_the_bin_at_the_wall) {
  EXPECT_THAT(area_fractions(rectangles({{0, -1}}, 2, 3), 2, {.height = 8, .count = 4}),
              ElementsAre(DoubleNear(1.5, 1e-14), 0, 0, 0));
}

TEST(Slices, have_the_moments_of_their_parts) {
  std::vector<Slice> slices(2);
  add_slices(rectangles({{1, 1}}, 2, 4), 0, {0, 0}, {.height = 6, .count = 2}, slices);
  EXPECT_NEAR(slices[0].area, 4, 1e-14);
  EXPECT_NEAR(slices[0].moment.x(), 4 * 2, 1e-13);
  EXPECT_NEAR(slices[0].moment.y(), 4 * 2, 1e-13);
  EXPECT_NEAR(slices[1].moment.y(), 4 * 4, 1e-13);
}

LateralMoments moments_of(const EnsembleState& state, double height) {
  return lateral_moments(state, measure_cells(state), height);
}

TEST(LateralMoments, of_a_filled_channel_are_those_of_a_uniform_distribution) {
  // Eight layers of height 1 from wall to wall.
  std::vector<Vector<2>> corners;
  for (int k = 0; k < 8; ++k) corners.emplace_back(0, k);
  const LateralMoments moments = moments_of(rectangles(corners, 3, 1), 8);
  EXPECT_NEAR(moments.width, 1, 1e-12);
  EXPECT_NEAR(moments.core_fraction, 0.5, 1e-12);
  EXPECT_NEAR(moments.mean_distance, 0.5, 1e-12);
  EXPECT_NEAR(moments.second_moment, 64.0 / 12 - 1.0 / 12, 1e-12);
}

TEST(LateralMoments, of_known_cells) {
  // Centres at 2 and 7 of 8; the first is cut in half by the border of the core at 2.
  const LateralMoments moments = moments_of(rectangles({{0, 1}, {0, 6}}, 1, 2), 8);
  EXPECT_NEAR(moments.mean_distance, 0.5 * (0.5 + 0.75), 1e-14);
  EXPECT_NEAR(moments.second_moment, 0.5 * (4 + 9), 1e-13);
  EXPECT_NEAR(moments.core_fraction, 0.25, 1e-14);
  EXPECT_NEAR(moments.width, std::sqrt((6.5 + 4.0 / 12) / (64.0 / 12)), 1e-13);
}

TEST(DistanceHistogram, counts_centres_from_the_axis_to_the_walls) {
  const EnsembleState state = ellipses(
      {{{0, 5.1}, 1, 1, 0}, {{0, 4.2}, 1, 1, 0}, {{0, 9.9}, 1, 1, 0}, {{0, 2.6}, 1, 1, 0}}, 12);
  EXPECT_THAT(distance_histogram(state, measure_cells(state), 10, 4),
              ElementsAre(0.5, 0.25, 0, 0.25));
}

TEST(DistanceHistogram, refuses_a_cell_outside_the_channel) {
  const EnsembleState state = ellipses({{{0, 10.5}, 1, 1, 0}}, 12);
  EXPECT_THROW(distance_histogram(state, measure_cells(state), 10, 4), NumericalError);
}

TEST(HalfCoreDistance, lies_where_the_profile_reaches_half_of_the_core) {
  // Bins of width 1; the core is 0.4, half of it is reached between the middles of bins.
  const std::vector<double> fractions = {0, 0.1, 0.3, 0.4, 0.4, 0.4, 0.4, 0.2, 0, 0};
  const double core = (0.15 + 0.4 * 4 + 0.1) / 5;  // bins 2.5 to 7.5
  EXPECT_NEAR(core_value(fractions), core, 1e-14);
  const double lower = 1.5 + (0.5 * core - 0.1) / 0.2;
  const double upper = 1.5 + 0.5 * core / 0.2;
  EXPECT_NEAR(half_core_distance(fractions, 10).value(), 0.5 * (lower + upper), 1e-13);
}

TEST(HalfCoreDistance, is_counted_from_the_wall_if_the_first_bin_is_full) {
  EXPECT_NEAR(half_core_distance(std::vector<double>(8, 0.3), 8).value(), 0.25, 1e-14);
}

TEST(HalfCoreDistance, is_none_without_a_core) {
  EXPECT_FALSE(half_core_distance(std::vector<double>{0.4, 0, 0, 0.4}, 4).has_value());
}

TEST(EnvelopeLayer, is_the_mean_distance_of_the_outermost_membranes) {
  const Box box{.length = 8, .height = 8, .walls = true};
  // The second covers columns 7 and 0, across the seam; columns 1 to 2 and 7 to 0 are covered.
  const auto layer = envelope_layer(rectangles({{1.1, 2}, {7.1, 4}}, 1.8, 3), box, 1).value();
  EXPECT_NEAR(layer.lower, 0.5 * (2 + 4), 1e-14);
  EXPECT_NEAR(layer.upper, 0.5 * (3 + 1), 1e-14);
  EXPECT_NEAR(layer.covered, 0.5, 1e-14);
}

TEST(EnvelopeLayer, cuts_sloping_membranes_at_the_borders_of_columns) {
  EnsembleState state;
  state.cells = 1;
  state.nodes = 3;
  state.x = {0, 4, 0};
  state.y = {1, 5, 5};
  const auto layer = envelope_layer(state, {.length = 4, .height = 6, .walls = true}, 1).value();
  EXPECT_NEAR(layer.lower, 0.25 * (1 + 2 + 3 + 4), 1e-14);
  EXPECT_NEAR(layer.upper, 1, 1e-14);
}

TEST(EnvelopeLayer, is_none_without_cells) {
  EXPECT_FALSE(envelope_layer(EnsembleState{}, {.length = 4, .height = 6, .walls = true}));
}

}  // namespace
}  // namespace hemoscale::micro
