#include "micro/ensemble/lateral_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "micro/ensemble/interpenetration.hpp"

namespace hemoscale::micro {
namespace {

EnsembleState squares(const std::vector<Vector<2>>& corners, double side) {
  EnsembleState state;
  state.cells = corners.size();
  state.nodes = 8;
  for (const auto& corner : corners) {
    for (const auto& [a, b] : {std::pair{0.0, 0.0},
                               {0.5, 0.0},
                               {1.0, 0.0},
                               {1.0, 0.5},
                               {1.0, 1.0},
                               {0.5, 1.0},
                               {0.0, 1.0},
                               {0.0, 0.5}}) {
      state.x.push_back(corner.x() + a * side);
      state.y.push_back(corner.y() + b * side);
    }
  }
  return state;
}

TEST(AreaBelow, cuts_a_triangle_exactly) {
  const double x[] = {0, 4, 0};
  const double y[] = {0, 0, 4};
  EXPECT_DOUBLE_EQ(area_below(x, y, 3, 5), 8);
  EXPECT_DOUBLE_EQ(area_below(x, y, 3, 1), 8 - 4.5);
  EXPECT_DOUBLE_EQ(area_below(x, y, 3, -1), 0);
}

TEST(ProfileAverage, finds_fraction_velocity_and_free_layer_of_known_cells) {
  const double um = 1e-6;
  const Box box{.length = 8 * um, .height = 8 * um, .walls = true};
  // Two squares of side 2 um: between y = 2 and 4, and, across the periodic boundary, between 4
  // and 6.
  const EnsembleState state = squares({{2.05 * um, 2 * um}, {7.05 * um, 4 * um}}, 2 * um);
  const CubicProfile flow({.height = 8 * um, .velocities = {1, 1, 1, 1, 1}});
  ProfileAverage average(box, 4);
  average.add(state, flow, std::vector<double>(16, 6.0), 2, 4 * um);
  const LateralProfile profile = average.mean();
  ASSERT_EQ(profile.y.size(), 4U);
  EXPECT_NEAR(profile.y[1], 3 * um, 1e-18);
  EXPECT_NEAR(profile.area_fraction[0], 0, 1e-12);
  EXPECT_NEAR(profile.area_fraction[1], 0.25, 1e-12);
  EXPECT_NEAR(profile.area_fraction[2], 0.25, 1e-12);
  EXPECT_NEAR(profile.area_fraction[3], 0, 1e-12);
  EXPECT_DOUBLE_EQ(profile.cell_velocity[1], 1 + 6.0 / 2);
  EXPECT_EQ(profile.cell_velocity[0], 0);
  // Free above and below the first: 2 and 4 um; the second: 4 and 2 um.
  EXPECT_NEAR(profile.cell_free_layer, 3 * um, 1e-15);
  EXPECT_NEAR(profile.wall_pressure, 4 * um / (2 * 8 * um), 1e-12);
}

TEST(Interpenetration, counts_nodes_inside_other_cells_and_images) {
  const Box box{.length = 10, .height = 10, .walls = false};
  EXPECT_EQ(count_interpenetrating_nodes(squares({{1, 1}, {5, 5}}, 2), box), 0U);
  // The corner (2, 2) of the second lies in the first, and the corner (3, 3) of the first in the
  // second.
  EXPECT_EQ(count_interpenetrating_nodes(squares({{1, 1}, {2.2, 2.2}}, 2), box), 2U);
  // Across the corner of the box, the row above being displaced by 6.
  EnsembleState state = squares({{9, 9}, {4.2, 0.2}}, 2);
  EXPECT_EQ(count_interpenetrating_nodes(state, box), 0U);
  state.image_offset = 6;
  EXPECT_EQ(count_interpenetrating_nodes(state, box), 2U);
  EXPECT_EQ(count_interpenetrating_nodes(state, {.length = 10, .height = 10, .walls = true}), 0U);
}

}  // namespace
}  // namespace hemoscale::micro
