#include <gtest/gtest.h>

#include "coupling/report/timings.hpp"
#include "coupling/scene/child_process.hpp"

namespace hemoscale::coupling {
namespace {

ChildEnd measured(const std::string& script, double longest = 60) {
  return run_measured_child({{"/bin/sh", "-c", script}, ".", "/dev/null", {}, longest},
                            [](const std::string&) {});
}

TEST(MeasuredChild, cpu_time_counts_work_and_not_waiting) {
  const ChildEnd waiting = measured("sleep 0.3");
  EXPECT_GE(waiting.wall, 0.3);
  EXPECT_LT(waiting.cpu, 0.2);
  const ChildEnd working = measured("i=0; while [ $i -lt 300000 ]; do i=$((i + 1)); done");
  EXPECT_GT(working.cpu, 0.05);
  EXPECT_FALSE(working.timed_out);
}

TEST(MeasuredChild, cpu_time_holds_that_of_its_own_children) {
  const std::string work = "i=0; while [ $i -lt 300000 ]; do i=$((i + 1)); done";
  EXPECT_GT(measured("/bin/sh -c '" + work + "'; true").cpu, 0.05);
}

TEST(MeasuredChild, is_ended_when_its_time_is_over_even_if_its_children_hold_the_pipe) {
  const ChildEnd end = measured("sleep 20 & sleep 20", 0.2);
  EXPECT_TRUE(end.timed_out);
  EXPECT_EQ(end.status, 128 + 9);
  EXPECT_LT(end.wall, 10);
}

TEST(ProcessTiming, holds_the_whole_process) {
  const PartTiming before = process_timing();
  volatile double sum = 0;
  for (int i = 0; i < 10000000; ++i) sum = sum + 1;
  const PartTiming after = process_timing();
  EXPECT_GT(after.cpu, before.cpu);
  EXPECT_GT(after.wall, before.wall);
}

}  // namespace
}  // namespace hemoscale::coupling
