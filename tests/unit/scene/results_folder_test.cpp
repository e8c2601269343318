#include "coupling/scene/results_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "coupling/error.hpp"

namespace hemoscale::coupling {
namespace {

namespace fs = std::filesystem;

class ResultsFolderTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(base_); }
  void TearDown() override { fs::remove_all(base_); }
  void write(const fs::path& file) const { std::ofstream(file) << "x"; }

  fs::path base_ = fs::temp_directory_path() /
                   ("hemoscale-results-" +
                    std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
  fs::path folder_ = base_ / "results";
};

TEST_F(ResultsFolderTest, makes_a_new_folder) {
  EXPECT_EQ(prepare_results_folder(folder_, false), "");
  EXPECT_TRUE(fs::is_directory(folder_));
}

TEST_F(ResultsFolderTest, moves_earlier_results_aside_every_time) {
  for (int run = 0; run < 3; ++run) {
    prepare_results_folder(folder_, false);
    write(folder_ / "summary.json");
    write(folder_ / ("run-" + std::to_string(run)));
  }
  EXPECT_TRUE(fs::exists(base_ / "results.1" / "run-0"));
  EXPECT_TRUE(fs::exists(base_ / "results.2" / "run-1"));
  EXPECT_TRUE(fs::exists(folder_ / "run-2"));
}

TEST_F(ResultsFolderTest, leaves_a_folder_without_results_where_it_is) {
  fs::create_directories(folder_ / "openfoam");
  EXPECT_EQ(prepare_results_folder(folder_, false), "");
  EXPECT_TRUE(fs::exists(folder_ / "openfoam"));
}

TEST_F(ResultsFolderTest, a_restart_keeps_the_folder_and_needs_one) {
  EXPECT_THROW(prepare_results_folder(folder_, true), EnvironmentError);
  fs::create_directories(folder_);
  write(folder_ / "checkpoint-000001.h5");
  EXPECT_EQ(prepare_results_folder(folder_, true), "");
  EXPECT_TRUE(fs::exists(folder_ / "checkpoint-000001.h5"));
}

}  // namespace
}  // namespace hemoscale::coupling
