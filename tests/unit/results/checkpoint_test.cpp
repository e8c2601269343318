#include "micro/snapshot/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <thread>

#include "tests/unit/results/scratch_folder.hpp"

namespace hemoscale::tests {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

const std::map<std::string, std::string> identity{{"micro.cells", "16"}, {"seed", "7"}};

micro::Checkpoint checkpoint_of(std::int64_t number) {
  micro::Checkpoint checkpoint;
  checkpoint.number = number;
  checkpoint.time = 0.1 * static_cast<double>(number);
  checkpoint.identity = identity;
  checkpoint.texts = {{"version", "0.1.0"}, {"empty", ""}, {"bytes", std::string("a\0\xff\n", 4)}};
  micro::Snapshot& model = checkpoint.slots["micro/3"];
  model.reals["positions"] = {-0.0, 1.0 / 3, std::numeric_limits<double>::denorm_min(),
                              std::numeric_limits<double>::infinity(),
                              std::bit_cast<double>(std::uint64_t{0x7ff8000000000123})};
  model.reals["nothing yet"] = {};
  model.integers["counter"] = {std::numeric_limits<std::int64_t>::min(), -1, 1};
  checkpoint.slots[""] = {};
  checkpoint.slots["./%2F."].integers["."] = {4};
  return checkpoint;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void damage(const fs::path& path) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(2000);
  file.put('x');
}

TEST(Checkpoint, is_read_back_with_the_same_bits) {
  const ScratchFolder folder("checkpoint-bits");
  const micro::Checkpoint written = checkpoint_of(12);
  const fs::path path = write_checkpoint(folder / "made" / "on demand", written);
  EXPECT_EQ(path.filename(), "checkpoint-000012.h5");
  const micro::Checkpoint read = micro::read_checkpoint(path);
  EXPECT_EQ(read.number, 12);
  EXPECT_EQ(read.time, written.time);
  EXPECT_EQ(read.identity, written.identity);
  EXPECT_EQ(read.texts, written.texts);
  ASSERT_EQ(read.slots.size(), written.slots.size());
  for (const auto& [name, snapshot] : written.slots) {
    ASSERT_TRUE(read.slots.contains(name)) << name;
    EXPECT_EQ(read.slots.at(name).integers, snapshot.integers);
    ASSERT_EQ(read.slots.at(name).reals.size(), snapshot.reals.size());
    for (const auto& [key, values] : snapshot.reals) {
      const std::vector<double>& back = read.slots.at(name).reals.at(key);
      ASSERT_EQ(back.size(), values.size());
      for (std::size_t k = 0; k < values.size(); ++k) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(back[k]), std::bit_cast<std::uint64_t>(values[k]));
      }
    }
  }
}

TEST(Checkpoint, same_content_gives_the_same_file) {
  const ScratchFolder folder("checkpoint-same");
  const auto content = [](const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string first = content(write_checkpoint(folder / "a", checkpoint_of(1)));
  // Not a second later either.
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  EXPECT_EQ(first, content(write_checkpoint(folder / "b", checkpoint_of(1))));
}

TEST(Checkpoint, the_last_two_are_kept_and_an_abandoned_future_is_not) {
  const ScratchFolder folder("checkpoint-keep");
  for (const int number : {1, 2, 3, 9}) write_checkpoint(folder.path(), checkpoint_of(number));
  EXPECT_THAT(names_in(folder.path()), ElementsAre("checkpoint-000003.h5", "checkpoint-000009.h5"));
  std::ofstream(folder / "checkpoint-old.h5") << "not one of ours";
  write_checkpoint(folder.path(), checkpoint_of(4));
  EXPECT_THAT(names_in(folder.path()),
              ElementsAre("checkpoint-000003.h5", "checkpoint-000004.h5", "checkpoint-old.h5"));
  EXPECT_EQ(micro::newest_checkpoint(folder.path()), folder / "checkpoint-000004.h5");
}

TEST(Checkpoint, numbers_are_compared_as_numbers) {
  const ScratchFolder folder("checkpoint-order");
  write_checkpoint(folder.path(), checkpoint_of(999999), 5);
  write_checkpoint(folder.path(), checkpoint_of(1000000), 5);
  EXPECT_EQ(micro::newest_checkpoint(folder.path()), folder / "checkpoint-1000000.h5");
  EXPECT_EQ(micro::newest_checkpoint(folder / "absent"), std::nullopt);
}

TEST(Checkpoint, a_damaged_newest_one_is_reported_and_the_one_before_used) {
  const ScratchFolder folder("checkpoint-damaged");
  write_checkpoint(folder.path(), checkpoint_of(1));
  damage(write_checkpoint(folder.path(), checkpoint_of(2)));
  const micro::RestoredCheckpoint restored = micro::restore_checkpoint(folder.path(), identity);
  EXPECT_EQ(restored.checkpoint.number, 1);
  ASSERT_EQ(restored.warnings.size(), 1U);
  EXPECT_THAT(restored.warnings[0], HasSubstr("checkpoint-000002.h5: the checkpoint is damaged"));
  EXPECT_THAT(restored.warnings[0], HasSubstr("continuing from the older"));
  EXPECT_THAT(restored.warnings[0], HasSubstr("checkpoint-000001.h5"));

  damage(folder / "checkpoint-000001.h5");
  try {
    micro::restore_checkpoint(folder.path(), identity);
    FAIL() << "no error";
  } catch (const micro::EnvironmentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no checkpoint is whole"));
    EXPECT_THAT(error.what(), HasSubstr("checkpoint-000001.h5"));
    EXPECT_THAT(error.what(), HasSubstr("checkpoint-000002.h5"));
  }
}

TEST(Checkpoint, of_another_case_is_refused_with_every_difference) {
  const ScratchFolder folder("checkpoint-foreign");
  write_checkpoint(folder.path(), checkpoint_of(1));
  const std::map<std::string, std::string> other{{"seed", "8"}, {"micro.drag", "2"}};
  try {
    micro::restore_checkpoint(folder.path(), other);
    FAIL() << "no error";
  } catch (const micro::ForeignCheckpoint& error) {
    ASSERT_EQ(error.differences.size(), 3U);
    EXPECT_EQ(error.differences[0].key, "micro.cells");
    EXPECT_EQ(error.differences[0].in_case, std::nullopt);
    EXPECT_EQ(error.differences[1].key, "micro.drag");
    EXPECT_EQ(error.differences[1].in_checkpoint, std::nullopt);
    EXPECT_EQ(error.differences[2].in_checkpoint, "7");
    EXPECT_EQ(error.differences[2].in_case, "8");
    EXPECT_THAT(error.what(), HasSubstr("seed: '7' in the checkpoint, '8' in the case"));
    EXPECT_THAT(error.what(), HasSubstr("micro.cells: '16' in the checkpoint, absent in the case"));
  }
}

TEST(Checkpoint, absence_and_failure_name_path_and_reason) {
  const ScratchFolder folder("checkpoint-errors");
  std::ofstream(folder / "file") << "in the way";
  const auto message = [](auto&& call) -> std::string {
    try {
      call();
    } catch (const micro::EnvironmentError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message([&] { micro::restore_checkpoint(folder.path(), identity); }),
              HasSubstr(folder.path().string() + ": there is no checkpoint"));
  EXPECT_THAT(message([&] { micro::read_checkpoint(folder / "absent.h5"); }),
              HasSubstr("absent.h5: cannot open: No such file or directory"));
  EXPECT_THAT(message([&] { write_checkpoint(folder / "file" / "sub", checkpoint_of(1)); }),
              HasSubstr("Not a directory"));
  EXPECT_THAT(message([&] { micro::read_checkpoint(folder / "file"); }), HasSubstr("damaged"));
  EXPECT_THROW(write_checkpoint(folder.path(), checkpoint_of(-1)), micro::ParameterError);
  EXPECT_THROW(write_checkpoint(folder.path(), checkpoint_of(1), 0), micro::ParameterError);
}

}  // namespace
}  // namespace hemoscale::tests
