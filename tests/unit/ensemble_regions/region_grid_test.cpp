#include "micro/ensemble/regions/region_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hemoscale::micro::regions {
namespace {

using testing::Pair;

TEST(ChooseGrid, narrow_channels_are_cut_along_alone) {
  EXPECT_THAT(choose_grid(1, 500, 75, true, false), Pair(1, 1));
  EXPECT_THAT(choose_grid(2, 544, 75, true, false), Pair(2, 1));
  EXPECT_THAT(choose_grid(8, 544, 75, true, false), Pair(8, 1));
  EXPECT_THAT(choose_grid(7, 10, 1000, true, false), Pair(1, 7));
}

TEST(ChooseGrid, wide_channels_in_both_directions) {
  // Borders of 10 x 8 regions: 10 * 400 + 7 * 500; of 80 columns: 80 * 400.
  EXPECT_THAT(choose_grid(80, 500, 400, true, false), Pair(10, 8));
  EXPECT_THAT(choose_grid(16, 30, 30, true, true), Pair(4, 4));
}

std::vector<CellPlace> lattice(int columns, int rows) {
  std::vector<CellPlace> cells;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) cells.push_back({{i + 0.5, j + 0.5}, 1});
  }
  return cells;
}

TEST(CutRegions, divides_cells_equally_in_both_directions) {
  const RankMessages messages{Communicator()};
  const auto cells = lattice(20, 9);
  const RegionGrid grid = cut_regions(cells, 4, 3, {0, 0}, {20, 9}, messages);
  std::vector<int> counts(12, 0);
  for (const CellPlace& cell : cells)
    ++counts.at(static_cast<std::size_t>(grid.owner(cell.position)));
  EXPECT_THAT(counts, testing::Each(15));
  EXPECT_EQ(grid.owner({0, 0}), 0);
  EXPECT_EQ(grid.owner({19.9, 8.9}), 11);
  EXPECT_THAT(grid.x_cuts, testing::SizeIs(3));
  EXPECT_NEAR(grid.middle(0, {0, 0}, {20, 9}).x(), 2.5, 0.5);
}

TEST(CutRegions, weighs_cells_by_their_work) {
  const RankMessages messages{Communicator()};
  auto cells = lattice(10, 1);
  cells.back().weight = 9;  // as much as all others together
  const RegionGrid grid = cut_regions(cells, 2, 1, {0, 0}, {10, 1}, messages);
  EXPECT_EQ(grid.owner({8.5, 0.5}), 0);
  EXPECT_EQ(grid.owner({9.5, 0.5}), 1);
}

}  // namespace
}  // namespace hemoscale::micro::regions
