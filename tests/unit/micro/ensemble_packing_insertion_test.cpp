#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "micro/ensemble/packing/insertion.hpp"
#include "micro/ensemble/packing/lattice_packing.hpp"
#include "micro/ensemble/packing/platelets.hpp"
#include "micro/ensemble/packing/state_checks.hpp"
#include "tests/support/micro/packed_cells.hpp"

namespace hemoscale::micro {
namespace {

using test::state_of;
using testing::HasSubstr;

constexpr double um = 1e-6;
const std::vector<Vector<2>> human = outline_nodes({}, 100);
const CellRoom open_room;

TEST(Occupancy, keeps_the_clearance_from_cells) {
  Occupancy occupancy(open_room, {.cells = 0.4 * um}, 8 * um);
  occupancy.add(placed(human, {0, 0}, 0));
  // Tips face each other along x.
  EXPECT_FALSE(occupancy.admits(placed(human, {8.2 * um, 0}, 0)));
  EXPECT_TRUE(occupancy.admits(placed(human, {8.23 * um, 0}, 0)));
  EXPECT_TRUE(occupancy.admits(placed(human, {500 * um, -300 * um}, 0)));
}

TEST(Occupancy, sees_cells_inside_each_other_either_way_round) {
  const auto small = outline_nodes({.outline = Outline::ellipse, .length = um, .aspect = 1}, 20);
  Occupancy large_first(open_room, {}, 8 * um);
  large_first.add(placed(human, {0, 0}, 0));
  EXPECT_FALSE(large_first.admits(placed(small, {2.5 * um, 0}, 0)));
  Occupancy small_first(open_room, {}, 8 * um);
  small_first.add(placed(small, {2.5 * um, 0}, 0));
  EXPECT_FALSE(small_first.admits(placed(human, {0, 0}, 0)));
}

TEST(Occupancy, sees_images_across_the_edges_of_a_box) {
  Occupancy occupancy({.length = 40 * um, .height = 30 * um}, {}, 8 * um);
  occupancy.add(placed(human, {39 * um, 29 * um}, 0));
  EXPECT_FALSE(occupancy.admits(placed(human, {1 * um, 1 * um}, 0)));
  EXPECT_FALSE(occupancy.admits(placed(human, {-39 * um, 61 * um}, 0)));
  EXPECT_TRUE(occupancy.admits(placed(human, {1 * um, 10 * um}, 0)));
  // A cell as long as the box would meet itself.
  EXPECT_FALSE(Occupancy({.length = 7.8 * um}, {}, 8 * um).admits(placed(human, {0, 0}, 0)));
}

TEST(Occupancy, keeps_cells_in_the_fluid) {
  const Occupancy channel({.height = 20 * um, .plane_walls = true}, {.walls = 0.5 * um}, 8 * um);
  EXPECT_FALSE(channel.admits(placed(human, {0, 1.7 * um}, 0)));
  EXPECT_TRUE(channel.admits(placed(human, {0, 1.9 * um}, 0)));
  EXPECT_FALSE(channel.admits(placed(human, {0, 18.3 * um}, 0)));
  const std::vector<std::vector<Vector<2>>> walls = {{{0, 0}, {40 * um, 0}},
                                                     {{40 * um, 20 * um}, {0, 20 * um}}};
  const Occupancy general({.geometry = std::make_shared<WallGeometry>(walls, 5 * um),
                           .openings = {{"outlet", {40 * um, 0}, {40 * um, 20 * um}}}},
                          {.walls = 0.5 * um}, 8 * um);
  EXPECT_FALSE(general.admits(placed(human, {20 * um, 1.7 * um}, 0)));
  EXPECT_TRUE(general.admits(placed(human, {20 * um, 1.9 * um}, 0)));
  EXPECT_FALSE(general.admits(placed(human, {41 * um, 10 * um}, 0)));
}

TEST(Occupancy, refuses_sizes_that_are_none) {
  EXPECT_THROW(Occupancy(open_room, {.cells = -1}, 1), ParameterError);
  EXPECT_THROW(Occupancy(open_room, {}, 0), ParameterError);
  EXPECT_THROW(Occupancy(open_room, {}, std::numeric_limits<double>::infinity()), ParameterError);
}

TEST(FreePlace, is_the_wanted_one_or_the_nearest) {
  Occupancy occupancy(open_room, {.cells = 0.3 * um}, 8 * um);
  Search search;
  search.place = {1 * um, 2 * um};
  search.angle = 0.3;
  search.reach_along = 6 * um;
  search.back = {0, -1};
  search.reach_back = 4 * um;
  const auto first = free_place(occupancy, human, search);
  ASSERT_TRUE(first);
  EXPECT_EQ(*first, placed(human, search.place, 0.3));
  occupancy.add(*first);
  const auto second = free_place(occupancy, human, search);
  ASSERT_TRUE(second);
  EXPECT_TRUE(occupancy.admits(*second));
  Vector<2> centre = Vector<2>::Zero();
  for (const auto& node : *second) centre += node / 100;
  // Side by side, as thick as a cell.
  EXPECT_LT((centre - search.place).norm(), 3.5 * um);
  search.reach_along = 0.5 * um;
  search.reach_back = 0.5 * um;
  EXPECT_FALSE(free_place(occupancy, human, search));
}

TEST(Platelets, are_small_stiff_ellipses_with_the_drag_of_a_cell) {
  const PlateletParameters p;
  const Platelets platelets = make_platelets(p, 1.2e-3);
  EXPECT_EQ(platelets.kind.mesh.nodes, 28);
  EXPECT_NEAR(platelets.kind.mesh.rest_area, std::numbers::pi / 4 * 2.5e-6 * 1e-6, 0.03e-12);
  EXPECT_DOUBLE_EQ(28 * platelets.kind.node_drag, 12 * 1.2e-3);
  EXPECT_EQ(platelets_for(1200, p), 75U);
  PlateletParameters wrong = p;
  wrong.thickness = 3e-6;
  EXPECT_THROW(make_platelets(wrong, 1.2e-3), ParameterError);
  wrong = p;
  wrong.membrane.stretch_modulus = 0;
  EXPECT_THROW(make_platelets(wrong, 1.2e-3), ParameterError);
  wrong = p;
  wrong.per_red_cell = -1;
  EXPECT_THROW(platelets_for(10, wrong), ParameterError);
}

TEST(Platelets, find_gaps_between_red_cells_or_say_that_there_are_too_few) {
  const Box box{.length = 60 * um, .height = 30 * um, .walls = true};
  const EnsembleState red =
      pack_on_lattice(human, box, {.cells = 35, .wall_gap = 0.3 * um}, 1, 0).state;
  const Platelets platelets = make_platelets({}, 1.2e-3);
  const Bounds all{0, box.length, 0, box.height};
  const Clearance clearance{.cells = 0.2 * um, .walls = 0.2 * um};
  const auto place = [&](std::size_t count, std::uint64_t seed) {
    return place_in_gaps(platelets.outline, count, std::span(&red, 1), room_of(box), all, clearance,
                         seed, 0);
  };
  const std::vector<EnsembleState> kinds = {red, place(12, 1)};
  EXPECT_EQ(kinds[1].cells, 12U);
  EXPECT_THAT(state_faults(kinds, room_of(box)), testing::IsEmpty());
  EXPECT_EQ(place(12, 1).x, kinds[1].x);
  EXPECT_NE(place(12, 2).x, kinds[1].x);
  EXPECT_THAT(test::refusal([&] { place(2000, 1); }), HasSubstr("of 2000 found a gap"));
}

}  // namespace
}  // namespace hemoscale::micro
