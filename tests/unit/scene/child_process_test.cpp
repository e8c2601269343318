#include "coupling/scene/child_process.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "coupling/error.hpp"

namespace hemoscale::coupling {
namespace {

class ChildProcessTest : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  ChildProcess shell(const std::string& script) const {
    return {{"/bin/sh", "-c", script}, folder_, folder_ / "log", {}};
  }
  std::string log() const {
    std::ifstream file(folder_ / "log");
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  std::vector<std::string> lines_of(const ChildProcess& child) {
    std::vector<std::string> lines;
    status_ = run_child(child, [&](const std::string& line) { lines.push_back(line); });
    return lines;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      ("hemoscale-child-" + std::to_string(testing::UnitTest::GetInstance()->random_seed()) + "-" +
       testing::UnitTest::GetInstance()->current_test_info()->name());
  int status_ = -1;
};

TEST_F(ChildProcessTest, passes_on_every_line_and_the_exit_status) {
  EXPECT_EQ(lines_of(shell("echo one; echo two >&2; printf three; exit 7")),
            (std::vector<std::string>{"one", "two", "three"}));
  EXPECT_EQ(status_, 7);
  EXPECT_EQ(log(), "one\ntwo\nthree");
}

TEST_F(ChildProcessTest, tells_the_signal_that_ended_it) {
  lines_of(shell("kill -9 $$"));
  EXPECT_EQ(status_, 128 + 9);
}

TEST_F(ChildProcessTest, runs_in_its_folder_with_its_environment) {
  ChildProcess child = shell("pwd; echo $HEMOSCALE_CHILD_TEST");
  child.environment["HEMOSCALE_CHILD_TEST"] = "given";
  const auto lines = lines_of(child);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(std::filesystem::canonical(lines[0]), std::filesystem::canonical(folder_));
  EXPECT_EQ(lines[1], "given");
}

TEST_F(ChildProcessTest, withholds_what_mpi_left_in_the_environment) {
  setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  EXPECT_EQ(lines_of(shell("echo [$OMPI_COMM_WORLD_SIZE] [$OMPI_ALLOW_RUN_AS_ROOT]")),
            std::vector<std::string>{"[] [1]"});
  unsetenv("OMPI_COMM_WORLD_SIZE");
  unsetenv("OMPI_ALLOW_RUN_AS_ROOT");
}

TEST_F(ChildProcessTest, program_that_does_not_exist_is_named) {
  try {
    run_child({{"hemoscale-no-such-program"}, folder_, folder_ / "log", {}}, [](const auto&) {});
    FAIL() << "nothing was thrown";
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find("hemoscale-no-such-program"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos);
  }
}

}  // namespace
}  // namespace hemoscale::coupling
