#include "micro/ensemble/blocks/block_schedule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace hemoscale::micro::blocks {
namespace {

struct ScheduleCase {
  std::size_t blocks, members, spread, tile, steps;
};
void PrintTo(const ScheduleCase& c, std::ostream* out) {
  *out << c.blocks << " blocks, " << c.members << " threads, spread " << c.spread << ", tile "
       << c.tile << ", steps " << c.steps;
}

class BlockSchedule : public testing::TestWithParam<ScheduleCase> {
 protected:
  ScheduleShape shape(std::size_t member) const {
    const ScheduleCase& c = GetParam();
    return {c.blocks * member / c.members, c.blocks * (member + 1) / c.members, c.blocks, c.spread,
            c.tile};
  }
  std::vector<std::vector<BlockTask>> schedules() const {
    const ScheduleCase& c = GetParam();
    std::size_t round = c.steps;
    for (std::size_t m = 0; m < c.members; ++m) round = std::min(round, steps_of_round(shape(m)));
    EXPECT_GE(round, 2U);
    std::vector<std::vector<BlockTask>> all;
    for (std::size_t m = 0; m < c.members; ++m) {
      all.push_back(tiled_schedule(shape(m), c.steps, round));
    }
    return all;
  }
};

TEST_P(BlockSchedule, has_every_task_once) {
  const ScheduleCase& c = GetParam();
  std::vector<int> count(c.blocks * c.steps, 0);
  for (const auto& tasks : schedules()) {
    for (const BlockTask& t : tasks) {
      ASSERT_LT(t.block, c.blocks);
      ASSERT_LT(t.step, c.steps);
      ++count[t.step * c.blocks + t.block];
    }
  }
  EXPECT_EQ(std::count(count.begin(), count.end(), 1), static_cast<std::ptrdiff_t>(count.size()));
}

// Threads that take turns, each waiting until its next task may begin, come to the end; so does one
// thread that is far ahead of the others.
TEST_P(BlockSchedule, leads_to_the_end_without_a_cycle) {
  const ScheduleCase& c = GetParam();
  const auto all = schedules();
  for (const std::size_t burst : {1U, 1000000U}) {
    std::vector<std::size_t> done(c.blocks, 0);
    std::vector<std::size_t> next(c.members, 0);
    const auto may_begin = [&](const BlockTask& t) {
      for (std::size_t k = 0; k <= 2 * c.spread; ++k) {
        if (done[(t.block + c.blocks + k - c.spread) % c.blocks] < t.step) return false;
      }
      return done[t.block] == t.step;
    };
    bool moves = true;
    while (moves) {
      moves = false;
      for (std::size_t m = 0; m < c.members; ++m) {
        for (std::size_t k = 0; k < burst && next[m] < all[m].size(); ++k) {
          if (!may_begin(all[m][next[m]])) break;
          ++done[all[m][next[m]++].block];
          moves = true;
        }
      }
    }
    for (std::size_t m = 0; m < c.members; ++m) EXPECT_EQ(next[m], all[m].size());
  }
}

// That is what it is for: most blocks are advanced again before many others are.
TEST_P(BlockSchedule, comes_back_to_blocks_soon) {
  const ScheduleCase& c = GetParam();
  const auto tasks = schedules().front();
  std::vector<std::ptrdiff_t> seen(c.blocks, -1);
  std::size_t soon = 0;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const auto at = static_cast<std::ptrdiff_t>(k);
    std::ptrdiff_t& last = seen[tasks[k].block];
    soon += last >= 0 && at - last <= 2 * static_cast<std::ptrdiff_t>(c.tile) ? 1 : 0;
    last = at;
  }
  EXPECT_GT(2 * soon, tasks.size());
}

INSTANTIATE_TEST_SUITE_P(Shapes, BlockSchedule,
                         testing::Values(ScheduleCase{750, 1, 5, 57, 13},
                                         ScheduleCase{750, 2, 4, 60, 8},
                                         ScheduleCase{751, 3, 3, 50, 16},
                                         ScheduleCase{64, 1, 2, 40, 9},
                                         ScheduleCase{200, 7, 1, 30, 5}));

TEST(BlockScheduleRound, is_none_for_tiles_that_neighbours_fill) {
  EXPECT_EQ(steps_of_round({0, 100, 100, 40, 50}), 0U);
  EXPECT_EQ(steps_of_round({0, 100, 100, 5, 50}), 5U);
  EXPECT_EQ(steps_of_round({7, 7, 100, 5, 50}), 0U);
  EXPECT_EQ(steps_of_round({0, 100, 100, 5, 0}), 0U);
}

}  // namespace
}  // namespace hemoscale::micro::blocks
