#include <gtest/gtest.h>

#include <ctime>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

#include "micro/parallel/thread_team.hpp"
#include "tests/support/micro/block_runs.hpp"

namespace hemoscale::micro {
namespace {

using namespace std::chrono_literals;

TEST(ThreadTeam, calls_the_task_once_on_every_member) {
  for (const int size : {1, 2, 5}) {
    ThreadTeam team(size);
    EXPECT_EQ(team.size(), size);
    std::vector<int> calls(static_cast<std::size_t>(size), 0);
    std::vector<std::thread::id> ids(calls.size());
    team.run([&](int member) {
      ++calls[static_cast<std::size_t>(member)];
      ids[static_cast<std::size_t>(member)] = std::this_thread::get_id();
    });
    EXPECT_EQ(calls, std::vector<int>(static_cast<std::size_t>(size), 1));
    EXPECT_EQ(ids.front(), std::this_thread::get_id());
    for (std::size_t k = 1; k < ids.size(); ++k) EXPECT_NE(ids[k], ids[k - 1]);
  }
}

// What members wrote is seen after run(), and by the next task.
TEST(ThreadTeam, may_be_used_again_and_again) {
  ThreadTeam team(3);
  std::vector<std::int64_t> sums(3, 0);
  std::int64_t all = 0;
  for (int round = 0; round < 2000; ++round) {
    team.run([&](int member) { sums[static_cast<std::size_t>(member)] += all + member; });
    all = (sums[0] + sums[1] + sums[2]) % 1000;
  }
  std::vector<std::int64_t> wanted(3, 0);
  std::int64_t total = 0;
  for (int round = 0; round < 2000; ++round) {
    for (std::size_t member = 0; member < 3; ++member) {
      wanted[member] += total + static_cast<std::int64_t>(member);
    }
    total = (wanted[0] + wanted[1] + wanted[2]) % 1000;
  }
  EXPECT_EQ(sums, wanted);
}

TEST(ThreadTeam, throws_the_exception_of_the_first_member_that_failed) {
  ThreadTeam team(4);
  std::atomic<int> finished{0};
  const auto message = [&](auto fails) {
    try {
      team.run([&](int member) {
        if (fails(member)) throw std::runtime_error("member " + std::to_string(member));
        ++finished;
      });
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(message([](int m) { return m >= 2; }), "member 2");
  EXPECT_EQ(finished, 2);
  EXPECT_EQ(message([](int) { return true; }), "member 0");
  EXPECT_EQ(message([](int m) { return m == 3; }), "member 3");
  // A failure is told once.
  EXPECT_EQ(message([](int) { return false; }), "none");
  EXPECT_EQ(finished, 2 + 3 + 4);
}

TEST(ThreadTeam, may_end_without_having_worked) {
  for (int k = 0; k < 50; ++k) ThreadTeam team(4);
}

TEST(Milestone, lets_nobody_pass_before_it_is_reached) {
  ThreadTeam team(2);
  Milestone milestone;
  EXPECT_EQ(milestone.reached(), 0);
  std::vector<int> order;  // written by one member at a time, in turns
  Milestone other;
  team.run([&](int member) {
    for (std::int64_t k = 0; k < 1000; ++k) {
      if (member == 0) {
        other.wait_for(k);
        order.push_back(0);
        milestone.set(k + 1);
      } else {
        milestone.wait_for(k + 1);
        order.push_back(1);
        other.set(k + 1);
      }
    }
  });
  ASSERT_EQ(order.size(), 2000U);
  for (std::size_t k = 0; k < order.size(); ++k) EXPECT_EQ(order[k], k % 2);
}

TEST(Milestone, that_lies_behind_holds_nobody) {
  Milestone milestone;
  milestone.set(7);
  milestone.wait_for(7);
  milestone.wait_for(-3);
  EXPECT_EQ(milestone.reached(), 7);
}

TEST(Milestone, wakes_all_who_wait) {
  ThreadTeam team(4);
  Milestone milestone;
  std::atomic<int> passed{0};
  team.run([&](int member) {
    if (member == 0) {
      std::this_thread::sleep_for(20ms);
      EXPECT_EQ(passed, 0);
      milestone.set(5);
    } else {
      milestone.wait_for(member);  // each of another height
      ++passed;
    }
  });
  EXPECT_EQ(passed, 3);
}

double cpu_seconds(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Threads that wait must leave the core to others: for a milestone, for the next task, and for the
// members that still work.
TEST(Milestone, those_who_wait_sleep) {
  ThreadTeam team(4);
  Milestone milestone;
  std::vector<double> used(4, 0);
  const double before = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID);
  team.run([&](int member) {
    const double start = cpu_seconds(CLOCK_THREAD_CPUTIME_ID);
    if (member == 1) {
      std::this_thread::sleep_for(200ms);
      milestone.set(1);
    } else if (member > 1) {
      milestone.wait_for(1);
    }
    used[static_cast<std::size_t>(member)] = cpu_seconds(CLOCK_THREAD_CPUTIME_ID) - start;
  });
  std::this_thread::sleep_for(100ms);
  for (const double seconds : used) EXPECT_LT(seconds, 0.02);
  EXPECT_LT(cpu_seconds(CLOCK_PROCESS_CPUTIME_ID) - before, 0.06);
}

// A vessel that is fed is empty at first.
TEST(BlockEnsembleWithoutCells, advances) {
  test::BlockCase c = test::lonely_cell_in_channel();
  EnsembleState& none = c.initial.front();
  none.cells = 0;
  none.x.clear();
  none.y.clear();
  for (const int threads : {1, 2}) {
    c.settings.threads = threads;
    BlockEnsemble ensemble = c.make(Precision::single);
    ensemble.advance(100);
    EXPECT_EQ(ensemble.step(), 100);
    EXPECT_TRUE(ensemble.states().front().x.empty());
  }
}

}  // namespace
}  // namespace hemoscale::micro
