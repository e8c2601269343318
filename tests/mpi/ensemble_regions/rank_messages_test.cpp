#include "micro/ensemble/regions/rank_messages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <thread>

#include "micro/ensemble/regions/region_grid.hpp"

namespace hemoscale::micro::regions {
namespace {

std::string text_for(int from, int to) {
  return std::string(static_cast<std::size_t>(20000 * (from + 1) + to),
                     static_cast<char>('a' + to));
}

TEST(RankMessages, reach_those_who_do_not_expect_them) {
  const Communicator all(MPI_COMM_WORLD);
  const RankMessages messages(all);
  // Everybody writes to rank 0, the last rank, and itself.
  std::vector<Message> outgoing;
  for (int to = 0; to < all.size(); ++to) {
    if (to == 0 || to == all.size() - 1 || to == all.rank()) {
      outgoing.push_back({to, text_for(all.rank(), to)});
    }
  }
  const std::vector<Message> incoming = messages.exchange(std::move(outgoing));
  const bool is_written_to = all.rank() == 0 || all.rank() == all.size() - 1;
  ASSERT_EQ(incoming.size(), is_written_to ? static_cast<std::size_t>(all.size()) : 1);
  int sender = is_written_to ? 0 : all.rank();
  for (const Message& message : incoming) {
    EXPECT_EQ(message.rank, sender);
    EXPECT_EQ(message.bytes, text_for(sender, all.rank()));
    ++sender;
  }
}

TEST(RankMessages, pass_between_ranks_that_know_each_other) {
  const Communicator all(MPI_COMM_WORLD);
  const RankMessages messages(all);
  std::vector<Message> outgoing;
  for (int to = 0; to < all.size(); ++to) {
    if (to != all.rank()) outgoing.push_back({to, to == 0 ? "" : text_for(all.rank(), to)});
  }
  for (const Message& message : messages.exchange_with(outgoing)) {
    EXPECT_EQ(message.bytes, all.rank() == 0 ? "" : text_for(message.rank, all.rank()));
  }
}

TEST(RankMessages, join_numbers) {
  const Communicator all(MPI_COMM_WORLD);
  const RankMessages messages(all);
  const int n = all.size();
  EXPECT_EQ(messages.sum({all.rank(), 1}), (std::vector<std::int64_t>{n * (n - 1) / 2, n}));
  EXPECT_EQ(messages.smallest(all.rank() + 0.5), 0.5);
  EXPECT_EQ(messages.largest(all.rank() + 0.5), n - 0.5);
  std::vector<double> expected;
  for (int k = 0; k < n; ++k) expected.insert(expected.end(), {1.0 * k, 2.0 * k});
  EXPECT_EQ(messages.gather({1.0 * all.rank(), 2.0 * all.rank()}), expected);
}

TEST(RankMessages, waiting_holds_no_core) {
  const Communicator all(MPI_COMM_WORLD);
  if (all.size() == 1) return;
  const RankMessages messages(all);
  messages.sum({0});
  constexpr auto late = std::chrono::milliseconds(500);
  if (all.rank() == 0) std::this_thread::sleep_for(late);
  const std::clock_t begin = std::clock();
  messages.sum({0});
  const double used = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  // A blocking call takes all of the half second; of processor time, whatever else runs here.
  EXPECT_LT(used, 0.2);
}

TEST(RegionGrid, all_ranks_find_the_same_equal_shares_wherever_the_cells_are) {
  const Communicator all(MPI_COMM_WORLD);
  const RankMessages messages(all);
  // 97 cells, crowded towards the left; every rank holds some of them at first.
  std::vector<CellPlace> cells;
  std::vector<CellPlace> own;
  for (int k = 0; k < 97; ++k) {
    cells.push_back({{100 * std::pow(k / 97.0, 2), (37 * k) % 97 / 97.0}, 10});
    if (k % all.size() == all.rank()) own.push_back(cells.back());
  }
  const RegionGrid grid = cut_regions(own, all.size(), 1, {0, 0}, {100, 1}, messages);
  std::vector<int> counts(static_cast<std::size_t>(all.size()), 0);
  for (const CellPlace& cell : cells) ++counts[static_cast<std::size_t>(grid.owner(cell.position))];
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  EXPECT_LE(*most - *least, 1);
  const std::vector<double> first =
      messages.gather({grid.x_cuts.empty() ? 0 : grid.x_cuts.front()});
  EXPECT_THAT(first, testing::Each(first.front()));
}

}  // namespace
}  // namespace hemoscale::micro::regions
