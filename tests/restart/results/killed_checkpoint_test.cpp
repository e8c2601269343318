#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "micro/snapshot/checkpoint.hpp"
#include "tests/restart/results/interrupted_writes.hpp"
#include "tests/unit/results/scratch_folder.hpp"

namespace hemoscale::tests {
namespace {

const std::map<std::string, std::string> identity{{"seed", "7"}};

micro::Checkpoint checkpoint_of(std::int64_t number) {
  micro::Checkpoint checkpoint;
  checkpoint.number = number;
  checkpoint.identity = identity;
  checkpoint.slots["model"].reals["positions"] =
      std::vector<double>(20000, static_cast<double>(number));
  return checkpoint;
}

class InterruptedCheckpoint : public testing::TestWithParam<Interruption> {};

TEST_P(InterruptedCheckpoint, leaves_the_one_before_whole) {
  const ScratchFolder folder("interrupted-checkpoint");
  write_checkpoint(folder.path(), checkpoint_of(1));
  bool was_reached = true;
  int call = 0;
  for (; was_reached; ++call) {
    SCOPED_TRACE(call);
    const Ending ending = interrupt(GetParam(), call, [&] {
      try {
        write_checkpoint(folder.path(), checkpoint_of(2));
      } catch (const micro::EnvironmentError& error) {
        const std::string text = error.what();
        const bool is_right = text.find(folder.path().string()) != std::string::npos &&
                              text.find("No space left on device") != std::string::npos;
        return is_right ? 1 : 2;
      }
      return 0;
    });
    was_reached = ending.was_reached;
    if (GetParam() == Interruption::disk_full) {
      ASSERT_FALSE(ending.was_killed);
      EXPECT_EQ(ending.exit_status, was_reached ? 1 : 0);
    }
    const micro::RestoredCheckpoint restored = micro::restore_checkpoint(folder.path(), identity);
    EXPECT_TRUE(restored.warnings.empty());
    const std::int64_t number = restored.checkpoint.number;
    if (!was_reached) {
      EXPECT_EQ(number, 2);
    }
    ASSERT_TRUE(number == 1 || number == 2);
    EXPECT_EQ(restored.checkpoint.slots.at("model").reals.at("positions"),
              checkpoint_of(number).slots.at("model").reals.at("positions"));
    std::filesystem::remove(folder / "checkpoint-000002.h5");
  }
  EXPECT_GE(call, 4);  // or the calls were not counted
  EXPECT_FALSE(std::filesystem::exists(folder / "checkpoint-000002.h5.part"));
}

INSTANTIATE_TEST_SUITE_P(Kinds, InterruptedCheckpoint,
                         testing::Values(Interruption::kill_before, Interruption::kill_within,
                                         Interruption::disk_full));

}  // namespace
}  // namespace hemoscale::tests
