#include <gtest/gtest.h>

#include "tests/support/micro/block_pairs.hpp"

// The list of contacts against a search of all nodes and images.
namespace hemoscale::micro {
namespace {

using test::Periodicity;

struct ListCase {
  const char* name;
  test::RandomCells box;
  Periodicity periodicity;
  std::vector<blocks::CellKind> kinds = {{40, 12}, {17, 5}};
};

void PrintTo(const ListCase& c, std::ostream* out) {
  *out << c.name;
}

class BlockLists : public testing::TestWithParam<ListCase> {};

template <class Real>
void expect_complete(const ListCase& c) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    test::RandomCells box = c.box;
    box.seed = seed;
    const auto cells = test::random_cells(c.kinds, box);
    const auto store = blocks::make_store<Real>(c.kinds, cells, cells.size(), false, 0);
    const auto list = blocks::find_contacts(store, 0, c.periodicity, 0.6);
    std::size_t pairs = 0;
    // Less than the range by what single precision loses of positions.
    EXPECT_EQ(test::missing_pairs(store, 0, c.periodicity, 0.6 - 2e-6, {list}, &pairs), 0)
        << "seed " << seed;
    EXPECT_GT(pairs, 0);
    for (std::size_t k = 0; k < list.neighbours.size(); ++k) {
      EXPECT_NE(store.ids[static_cast<std::size_t>(list.neighbours[k].place)], blocks::no_cell);
    }
  }
}

TEST_P(BlockLists, hold_every_pair_in_the_range) {
  expect_complete<float>(GetParam());
  expect_complete<double>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Domains, BlockLists,
    testing::Values(
        ListCase{"channel", {.width = 30, .height = 14}, {30, 0, 0}},
        ListCase{"no_period", {.width = 25, .height = 25}, {0, 0, 0}},
        ListCase{"unwrapped", {.width = 300, .height = 14}, {30, 0, 0}},
        ListCase{"shear_box", {.width = 24, .height = 20}, {24, 20, 0}},
        ListCase{"offset_beyond_half", {.width = 24, .height = 20}, {24, 20, 15.3}},
        ListCase{"offset_of_many_periods", {.width = 24, .height = 20}, {24, 20, -1234.5}},
        ListCase{"far_rows", {.width = 24, .height = 90}, {24, 20, 7.7}},
        ListCase{"meets_two_images", {.width = 11, .height = 11}, {11, 11, 6}, {{40, 2}, {17, 1}}},
        ListCase{"meets_itself", {.width = 8, .height = 8.2}, {8, 8.2, 3}, {{40, 1}, {17, 1}}},
        ListCase{"upright_in_a_low_box",
                 {.width = 12, .height = 7.4, .turn = 1e-3},
                 {12, 7.4, 5},
                 {{40, 3}}},
        ListCase{"lower_than_a_cell", {.width = 9, .height = 4}, {9, 4, 2.2}, {{40, 3}}},
        ListCase{"shorter_than_a_cell", {.width = 4, .height = 12}, {4, 0, 0}, {{40, 3}}}),
    [](const auto& each) { return std::string(each.param.name); });

// Every pair of cells appears with either of them: the order of steps relies on it.
TEST(BlockList, knows_every_neighbour_from_both_sides) {
  const std::vector<blocks::CellKind> kinds = {{40, 30}};
  const Periodicity sliding{24, 20, 15.3};
  const auto cells = test::random_cells(kinds, {.width = 24, .height = 20, .seed = 3});
  const auto store = blocks::make_store<float>(kinds, cells, cells.size(), false, 0);
  const auto list = blocks::find_contacts(store, 0, sliding, 0.6);
  std::set<std::tuple<std::int32_t, std::int32_t, std::int32_t, std::int32_t>> seen;
  for (std::size_t place = 0; place < store.places(); ++place) {
    for (std::size_t k = list.first_neighbour[place]; k < list.first_neighbour[place + 1]; ++k) {
      const auto& other = list.neighbours[k];
      seen.insert({static_cast<std::int32_t>(place), other.place, other.column, other.row});
    }
  }
  ASSERT_FALSE(seen.empty());
  for (const auto& [mine, theirs, column, row] : seen) {
    EXPECT_EQ(seen.count({theirs, mine, -column, -row}), 1U);
  }
}

}  // namespace
}  // namespace hemoscale::micro
