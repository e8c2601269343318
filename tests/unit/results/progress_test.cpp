#include "coupling/report/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <string>

namespace hemoscale::tests {
namespace {

using coupling::format_duration;
using coupling::Progress;
using testing::HasSubstr;
using testing::Not;

/// Progress on a file, with a clock that the test turns.
class ProgressTest : public testing::Test {
 protected:
  void SetUp() override {
    stream = std::tmpfile();
    ASSERT_NE(stream, nullptr);
    options.stream = stream;
    options.clock = [this] { return now; };
  }
  void TearDown() override { std::fclose(stream); }

  std::string shown() {
    std::rewind(stream);
    std::string text;
    std::array<char, 4096> block{};
    for (std::size_t count = 1; count > 0;) {
      count = std::fread(block.data(), 1, block.size(), stream);
      text.append(block.data(), count);
    }
    return text;
  }

  std::FILE* stream = nullptr;
  double now = 100;  // [s]
  coupling::ProgressOptions options;
};

TEST_F(ProgressTest, plain_lines_come_at_their_interval) {
  {
    Progress progress("pass", 0, 10, options);
    for (int k = 1; k <= 9; ++k) {
      now += 4;
      progress.update(k, "change 0.1");
    }
    now += 4;
    progress.update(10);
  }
  EXPECT_EQ(shown(),
            "pass 1 of 10 (10 %), change 0.1, 36 s left\n"
            "pass 4 of 10 (40 %), change 0.1, 24 s left\n"
            "pass 7 of 10 (70 %), change 0.1, 12 s left\n"
            "pass 10 of 10 (100 %), 0.0 s left\n"
            "pass 10 of 10 (100 %), took 40 s\n");
}

TEST_F(ProgressTest, a_restart_is_not_counted_as_speed) {
  Progress progress("time", 80, 100, options);
  now += 50;
  progress.update(90);
  EXPECT_THAT(shown(), HasSubstr("time 90 of 100 (90 %), 50 s left"));
}

TEST_F(ProgressTest, a_terminal_shows_one_line_that_is_rewritten) {
  options.terminal_columns = 40;
  Progress progress("pass", 0, 4, options);
  now += 1;
  progress.update(1, "a note that is far too long for this terminal");
  now += 1;
  progress.update(2);
  progress.message("a message");
  now += 1;
  progress.finish();
  progress.update(3);  // says nothing any more
  const std::string text = shown();
  const std::string first = text.substr(0, text.find('\r', 1));
  EXPECT_EQ(first.size(), 40U);  // carriage return and 39 columns
  EXPECT_THAT(text, HasSubstr("\rpass 2 of 4 (50 %), 2.0 s left         "));
  EXPECT_THAT(text, HasSubstr("\ra message\n"));
  EXPECT_THAT(text, testing::EndsWith("\rpass 2 of 4 (50 %), took 3.0 s\n"));
}

TEST_F(ProgressTest, other_ranks_show_nothing) {
  options.is_root = false;
  {
    Progress progress("pass", 0, 4, options);
    progress.update(1);
    progress.message("text");
  }
  EXPECT_EQ(shown(), "");
}

TEST_F(ProgressTest, an_unknown_end_gives_no_remaining_time) {
  {
    Progress progress("step", 0, 0, options);
    now += 5;
    progress.update(1200);
  }
  EXPECT_EQ(shown(), "step 1200\nstep 1200, took 5.0 s\n");
}

TEST_F(ProgressTest, a_file_is_not_a_terminal) {
  Progress progress("pass", 0, 4, options);
  progress.update(1);
  EXPECT_THAT(shown(), Not(HasSubstr("\r")));
}

TEST(FormatDuration, uses_two_units_at_most) {
  EXPECT_EQ(format_duration(0), "0.0 s");
  EXPECT_EQ(format_duration(9.94), "9.9 s");
  EXPECT_EQ(format_duration(9.96), "10 s");
  EXPECT_EQ(format_duration(59.6), "1 min 00 s");
  EXPECT_EQ(format_duration(200), "3 min 20 s");
  EXPECT_EQ(format_duration(3600), "1 h 00 min");
  EXPECT_EQ(format_duration(3720), "1 h 02 min");
  EXPECT_EQ(format_duration(3599.7), "1 h 00 min");
  EXPECT_EQ(format_duration(48 * 3600 + 7200), "2 d 02 h");
  EXPECT_EQ(format_duration(-1), "unknown time");
  EXPECT_EQ(format_duration(1.0 / 0.0), "unknown time");
}

}  // namespace
}  // namespace hemoscale::tests
