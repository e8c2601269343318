#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "micro/ensemble/interpenetration.hpp"
#include "micro/ensemble/packing/interpenetration_watch.hpp"
#include "micro/ensemble/packing/state_checks.hpp"
#include "tests/support/micro/packed_cells.hpp"

namespace hemoscale::micro {
namespace {

using test::state_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double um = 1e-6;
const std::vector<Vector<2>> human = outline_nodes({}, 60);
const CellRoom open_room;

std::vector<std::string> faults(const EnsembleState& state, const CellRoom& room) {
  return state_faults(std::span(&state, 1), room);
}

TEST(StateChecks, find_nothing_in_cells_that_are_apart) {
  const EnsembleState state = state_of(human, {{{0, 0}}, {{0, 2.7 * um}}, {{8 * um, 0}, 0.1}});
  EXPECT_THAT(faults(state, open_room), IsEmpty());
  EXPECT_EQ(count_interpenetrating_nodes(std::span(&state, 1), open_room), 0U);
}

TEST(StateChecks, name_cells_and_place_of_an_overlap) {
  const EnsembleState state = state_of(human, {{{50 * um, 0}}, {{0, 0}}, {{7 * um, 0}}});
  const auto found = overlaps(std::span(&state, 1), open_room);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].cell, 1U);
  EXPECT_EQ(found[0].other_cell, 2U);
  EXPECT_TRUE(found[0].crosses);
  EXPECT_NEAR(found[0].place.x(), 3.5 * um, 0.1 * um);
  EXPECT_THAT(faults(state, open_room),
              ElementsAre(HasSubstr("kind 0, cell 1 and kind 0, cell 2 interlock")));
}

// Two long thin cells that cross in the middle of long segments: no node lies inside the other.
TEST(StateChecks, see_cells_that_interlock_without_a_node_inside) {
  const std::vector<Vector<2>> bar = {
      {-5 * um, -0.5 * um}, {5 * um, -0.5 * um}, {5 * um, 0.5 * um}, {-5 * um, 0.5 * um}};
  const EnsembleState state = state_of(bar, {{{0, 0}}, {{0, 0}, std::numbers::pi / 2}});
  EXPECT_EQ(count_interpenetrating_nodes(std::span(&state, 1), open_room), 0U);
  const auto found = overlaps(std::span(&state, 1), open_room);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].crosses);
}

TEST(StateChecks, see_a_cell_wholly_inside_another_of_another_kind) {
  const auto small = outline_nodes({.outline = Outline::ellipse, .length = um, .aspect = 0.5}, 12);
  const std::vector<EnsembleState> kinds = {state_of(human, {{{0, 0}}}),
                                            state_of(small, {{{9 * um, 0}}, {{2.5 * um, 0}}})};
  const auto found = overlaps(kinds, open_room);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].crosses);
  EXPECT_EQ(found[0].other_kind, 1U);
  EXPECT_EQ(found[0].other_cell, 1U);
  EXPECT_NEAR(found[0].place.x(), 2.5 * um, 1e-3 * um);
  EXPECT_EQ(count_interpenetrating_nodes(kinds, open_room), 12U);
}

TEST(StateChecks, see_images_also_those_that_slide_and_those_of_the_cell_itself) {
  const EnsembleState near_edges = state_of(human, {{{1 * um, 5 * um}}, {{49 * um, 5 * um}}});
  CellRoom room{.length = 51 * um, .height = 20 * um, .plane_walls = true};
  EXPECT_EQ(overlaps(std::span(&near_edges, 1), room).size(), 1U);
  room.length = 57 * um;
  EXPECT_EQ(overlaps(std::span(&near_edges, 1), room).size(), 0U);

  const EnsembleState stacked = state_of(human, {{{20 * um, 1 * um}}, {{29 * um, 19 * um}}});
  room = {.length = 60 * um, .height = 20 * um};
  EXPECT_EQ(overlaps(std::span(&stacked, 1), room).size(), 0U);
  room.image_offset = -9 * um;  // the lower cell appears above at 11 um
  EXPECT_EQ(overlaps(std::span(&stacked, 1), room).size(), 0U);
  room.image_offset = 9 * um;  // at 29 um, over the other
  EXPECT_EQ(overlaps(std::span(&stacked, 1), room).size(), 1U);

  const EnsembleState alone = state_of(human, {{{20 * um, 10 * um}}});
  EXPECT_EQ(overlaps(std::span(&alone, 1), {.length = 7.5 * um}).size(), 1U);
  EXPECT_EQ(overlaps(std::span(&alone, 1), {.length = 8 * um}).size(), 0U);
  EXPECT_THAT(faults(alone, {.length = 7.5 * um}), ElementsAre(HasSubstr("an image of itself")));
}

TEST(StateChecks, name_cells_beyond_walls_and_openings_and_broken_numbers) {
  EnsembleState state = state_of(human, {{{10 * um, 1 * um}}, {{10 * um, 10 * um}}});
  CellRoom room{.length = 60 * um, .height = 20 * um, .plane_walls = true};
  EXPECT_THAT(faults(state, room),
              ElementsAre(testing::AllOf(HasSubstr("kind 0, cell 0"), HasSubstr("beyond a wall"))));
  const std::vector<std::vector<Vector<2>>> walls = {{{0, 5 * um}, {40 * um, 5 * um}},
                                                     {{40 * um, 30 * um}, {0, 30 * um}}};
  room = {.geometry = std::make_shared<WallGeometry>(walls, 5 * um),
          .openings = {{"inlet", {0, 30 * um}, {0, 5 * um}}}};
  EXPECT_THAT(faults(state, room), ElementsAre(HasSubstr("kind 0, cell 0")));
  state = state_of(human, {{{10 * um, 10 * um}}, {{-5 * um, 10 * um}}});
  EXPECT_THAT(faults(state, room), ElementsAre(testing::AllOf(HasSubstr("kind 0, cell 1"),
                                                              HasSubstr("beyond opening inlet"))));
  state.x[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(faults(state, room), testing::Contains(HasSubstr("cell 0: node 7 lies at")));
  EXPECT_THROW(require_sound(std::span(&state, 1), room), ParameterError);
}

TEST(StateChecks, list_a_few_faults_and_count_all) {
  std::vector<test::Placed> cells;
  for (int k = 0; k < 30; ++k) cells.push_back({{7 * um * k, 0}});
  const auto lines = faults(state_of(human, cells), open_room);
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_THAT(lines.back(), HasSubstr("29 in all"));
}

TEST(InterpenetrationWatch, keeps_the_worst_look) {
  InterpenetrationWatch watch(100);
  EXPECT_TRUE(watch.is_due(0));
  EXPECT_FALSE(watch.is_due(150));
  EXPECT_TRUE(watch.is_due(200));
  const EnsembleState apart = state_of(human, {{{0, 0}}, {{9 * um, 0}}});
  const EnsembleState meeting = state_of(human, {{{0, 0}}, {{7 * um, 0}}});
  EXPECT_EQ(watch.look(0, std::span(&apart, 1), open_room), 0U);
  EXPECT_GT(watch.look(100, std::span(&meeting, 1), open_room), 0U);
  EXPECT_EQ(watch.look(200, std::span(&apart, 1), open_room), 0U);
  EXPECT_EQ(watch.looks(), 3);
  EXPECT_GT(watch.largest(), 0U);
  EXPECT_EQ(watch.step_of_largest(), 100);
  EXPECT_THROW(InterpenetrationWatch(0), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
