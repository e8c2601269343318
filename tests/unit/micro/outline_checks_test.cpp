#include "micro/cells/outline_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "micro/cells/outline.hpp"
#include "micro/error.hpp"
#include "tests/support/micro/rings.hpp"

namespace hemoscale::micro {
namespace {

using test::Polygon;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Polygon square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

Polygon moved(Polygon polygon, double x, double y) {
  for (auto& node : polygon) {
    node += Vector<2>(x, y);
  }
  return polygon;
}

TEST(OutlineChecks, area_tells_the_orientation) {
  EXPECT_DOUBLE_EQ(enclosed_area(square), 1);
  EXPECT_DOUBLE_EQ(enclosed_area(Polygon(square.rbegin(), square.rend())), -1);
  EXPECT_DOUBLE_EQ(enclosed_area(moved(square, 5, -7)), 1);
}

TEST(OutlineChecks, finds_coincident_neighbours) {
  EXPECT_FALSE(coincident_neighbours(square));
  EXPECT_EQ(coincident_neighbours(Polygon{{0, 0}, {1, 0}, {1, 0}, {0, 1}}), 1U);
  EXPECT_EQ(coincident_neighbours(Polygon{{0, 0}, {1, 0}, {1, 1}, {0, 0}}), 3U);
  EXPECT_FALSE(coincident_neighbours(Polygon{{0, 0}, {1, 0}, {1, 1e-9}, {0, 1}}));
  EXPECT_TRUE(coincident_neighbours(Polygon{{0, 0}, {1, 0}, {std::nan(""), 1}, {0, 1}}));
}

// An hourglass whose waist closes: the two middle nodes come from both sides.
Polygon hourglass(double half_waist) {
  return {{-1, -1}, {0, -half_waist}, {1, -1}, {1, 1}, {0, half_waist}, {-1, 1}};
}

TEST(OutlineChecks, finds_self_crossing_on_both_sides_of_touching) {
  EXPECT_FALSE(self_crossing(hourglass(1e-9)));
  EXPECT_TRUE(self_crossing(hourglass(0)));
  const auto found = self_crossing(hourglass(-1e-9));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->first, 0U);
  EXPECT_EQ(found->second, 4U);
  EXPECT_LE(found->place.norm(), 2e-9);
  // A figure of eight: the first and the third of four segments.
  const auto eight = self_crossing(Polygon{{0, 0}, {1, 1}, {1, 0}, {0, 1}});
  ASSERT_TRUE(eight);
  EXPECT_EQ(eight->first, 0U);
  EXPECT_EQ(eight->second, 2U);
  EXPECT_DOUBLE_EQ(eight->place.x(), 0.5);
  EXPECT_DOUBLE_EQ(eight->place.y(), 0.5);
}

TEST(OutlineChecks, neighbours_cross_only_where_they_fold_back) {
  EXPECT_FALSE(self_crossing(square));
  EXPECT_FALSE(self_crossing(Polygon{{0, 0}, {1, 0}, {2, 0}, {1, 1}}));  // straight on
  EXPECT_FALSE(self_crossing(Polygon{{0, 0}, {2, 0}, {1, 1e-9}, {0, 1}}));
  EXPECT_TRUE(self_crossing(Polygon{{0, 0}, {2, 0}, {1, 0}, {0.5, 1}}));
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_FALSE(self_crossing(test::random_polygon(59, seed)));
  }
}

TEST(OutlineChecks, finds_crossing_rings_on_both_sides_of_touching) {
  const auto meet = [](const Polygon& a, const Polygon& b) { return crossing({a}, {b}); };
  EXPECT_FALSE(meet(square, moved(square, 1 + 1e-9, 0.5)));
  EXPECT_TRUE(meet(square, moved(square, 1, 0.5)));  // along a side
  EXPECT_TRUE(meet(square, moved(square, 1, 1)));    // in a corner
  EXPECT_FALSE(meet(square, moved(square, 1, 1 + 1e-9)));
  const auto found = meet(square, moved(square, 1 - 1e-9, 0.5));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->first, 1U);
  EXPECT_EQ(found->second, 0U);
  EXPECT_NEAR(found->place.x(), 1, 1e-12);
  EXPECT_NEAR(found->place.y(), 0.5, 1e-12);
}

TEST(OutlineChecks, finds_a_wall_on_both_sides_of_touching) {
  const auto touches = [](double height) {
    const Polygon wall = {{-10, height}, {0.5, height}, {10, height + 3}};
    return crossing({square}, {wall, false});
  };
  EXPECT_FALSE(touches(1 + 1e-9));
  EXPECT_TRUE(touches(1));
  ASSERT_TRUE(touches(0.9));
  EXPECT_EQ(touches(0.9)->first, 2U);
  EXPECT_EQ(touches(0.9)->second, 1U);
  EXPECT_FALSE(touches(-4));
  // An open chain has no segment from its last node to its first.
  const Polygon corner = {{-1, 0.5}, {-1, 3}, {3, 3}, {3, 0.5}};
  EXPECT_FALSE(crossing({square}, {corner, false}));
  EXPECT_TRUE(crossing({square}, {corner, true}));
}

// Every end of a piece of wall may lie on a cell, and the wall may be either of the two chains.
TEST(OutlineChecks, finds_ends_of_walls_that_touch) {
  for (const Vector<2>& end : {Vector<2>(1, 0.5), Vector<2>(1 + 1e-9, 0.5)}) {
    const bool touches = end.x() == 1;
    for (const Polygon& wall : {Polygon{end, {3, 0.7}}, Polygon{{3, 0.7}, end}}) {
      EXPECT_EQ(crossing({square}, {wall, false}).has_value(), touches);
      EXPECT_EQ(crossing({wall, false}, {square}).has_value(), touches);
    }
  }
}

TEST(OutlineChecks, knows_inside_from_outside) {
  const Polygon ring = hourglass(0.25);
  EXPECT_TRUE(encloses(ring, {0, 0}));
  EXPECT_TRUE(encloses(ring, {0.9, 0.8}));
  EXPECT_FALSE(encloses(ring, {0, 0.5}));
  EXPECT_FALSE(encloses(ring, {2, 0}));
  EXPECT_FALSE(encloses(ring, {-2, 0}));
}

TEST(OutlineChecks, measures_the_distance_of_rings_and_says_where) {
  constexpr double any = std::numeric_limits<double>::infinity();
  const Polygon triangle = {{1.5, 0.5}, {2.5, 0}, {2.5, 1}};
  const auto found = closest({square}, {triangle}, any);
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(found->distance, 0.5);
  EXPECT_FALSE(found->of_first);
  EXPECT_EQ(found->node, 0U);
  EXPECT_EQ(found->segment, 1U);
  EXPECT_EQ(found->place, Vector<2>(1.5, 0.5));
  const auto swapped = closest({triangle}, {square}, any);
  ASSERT_TRUE(swapped);
  EXPECT_TRUE(swapped->of_first);
  EXPECT_TRUE(closest({square}, {triangle}, 0.5));
  EXPECT_FALSE(closest({square}, {triangle}, 0.499));
  // Boxes near, chains not.
  const Polygon beyond = {{1.2, 1.2}, {3, 1.2}, {3, 3}};
  EXPECT_FALSE(closest({square}, {beyond}, 0.28));
  EXPECT_NEAR(closest({square}, {beyond}, 0.29)->distance, std::sqrt(0.08), 1e-15);
  const Polygon wall = {{-10, -0.125}, {10, -0.125}};
  EXPECT_DOUBLE_EQ(closest({square}, {wall, false}, any)->distance, 0.125);
}

TEST(OutlineChecks, measures_across_a_ring_and_not_along_it) {
  EXPECT_FALSE(closest_across(test::regular_polygon(59, 3e-6)));
  const auto waist = closest_across(hourglass(0.125));
  ASSERT_TRUE(waist);
  EXPECT_DOUBLE_EQ(waist->distance, 0.25);
  // Evans and Fung: the waist is 0.207161 R.
  const Polygon cell = outline_nodes({}, 60);
  const auto thin = closest_across(cell);
  ASSERT_TRUE(thin);
  EXPECT_NEAR(thin->distance, 0.207161 * 3.91e-6, 1e-3 * 3.91e-6);
  EXPECT_LT(std::abs(thin->place.x()), 0.3e-6);
}

TEST(OutlineChecks, names_cells_nodes_places_and_remedies) {
  const std::vector<Polygon> apart = {square, moved(square, 2, 0)};
  const Polygon ceiling = {{-5, 1.5}, {5, 1.5}};
  const std::vector<Chain> walls = {{ceiling, false}};
  EXPECT_THAT(outline_faults(apart, walls), IsEmpty());
  EXPECT_NO_THROW(require_separate(apart, walls));

  const std::vector<Polygon> overlapping = {square, moved(square, 3, 0), moved(square, 0.5, 0.75)};
  EXPECT_THAT(
      outline_faults(overlapping, walls),
      ElementsAre(HasSubstr("cells 0 and 2 overlap: segment 1 of the first meets segment 0"),
                  HasSubstr("cell 2 touches wall 0: segment 1 of the cell meets piece 0")));
  try {
    require_separate(overlapping, walls);
    FAIL() << "accepted";
  } catch (const ParameterError& error) {
    EXPECT_THAT(error.what(), HasSubstr("at (1, 0.75) m; cells must be apart; move one of them"));
    EXPECT_THAT(error.what(), HasSubstr("at (1.5, 1.5) m; cells must keep off walls"));
  }

  const Polygon small = {{0.4, 0.4}, {0.6, 0.4}, {0.5, 0.6}};
  EXPECT_THAT(outline_faults(std::vector<Polygon>{square, small}, {}),
              ElementsAre(HasSubstr("of cells 0 and 1 one lies inside the other")));
  EXPECT_THAT(outline_faults(std::vector<Polygon>{small, square}, {}),
              ElementsAre(HasSubstr("of cells 0 and 1 one lies inside the other")));

  const std::vector<Polygon> broken = {Polygon(square.rbegin(), square.rend()),
                                       {{0, 0}, {1, 1}, {1, 0}, {0, 1}},
                                       {{0, 0}, {1, 0}, {1, 0}},
                                       {{0, 0}, {1, 0}}};
  EXPECT_THAT(
      outline_faults(broken, {}),
      ElementsAre(HasSubstr("cell 0 encloses -1 m^2"),
                  HasSubstr("cell 1 crosses itself: segments 0 and 2"),
                  HasSubstr("cell 2: node 1 at (1, 0) m"), HasSubstr("cell 3 has 2 nodes")));
}

}  // namespace
}  // namespace hemoscale::micro
