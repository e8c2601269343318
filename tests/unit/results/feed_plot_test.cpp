#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "coupling/report/series.hpp"
#include "micro/snapshot/trajectory_file.hpp"
#include "tests/unit/results/pictures.hpp"
#include "tests/unit/results/python_script.hpp"
#include "tests/unit/results/sample_trajectory.hpp"
#include "tests/unit/results/scratch_folder.hpp"

namespace hemoscale::tests {
namespace {

class FeedPlot : public testing::Test {
 protected:
  void SetUp() override {
    for (const std::string module : {"matplotlib", "h5py"}) {
      if (!has_module(module)) GTEST_SKIP() << "python3-" << module << " is not installed";
    }
  }

  /// A row for each count of cells, of each of these kinds.
  void write_series(const std::vector<double>& cells,
                    const std::vector<std::string>& prefixes = {""}) const {
    std::vector<coupling::Column> columns = {{"time", "s"}};
    for (const std::string outlet : {"upper", "lower"}) {
      columns.push_back({"flow share of " + outlet, "-"});
    }
    for (const std::string& prefix : prefixes) {
      for (const std::string name :
           {"cells", "cells between the openings", "tube hematocrit", "left through upper",
            "left through lower", "cell share of upper", "cell share of lower"}) {
        columns.push_back({prefix + name, "-"});
      }
    }
    std::vector<std::vector<double>> rows;
    for (const double n : cells) {
      std::vector<double> row = {0.1 * static_cast<double>(rows.size()), 0.7, 0.3};
      for (std::size_t k = 0; k < prefixes.size(); ++k) {
        row.insert(row.end(), {n, n, 0.1 * n, n, n, 0.6, 0.4});
      }
      rows.push_back(row);
    }
    coupling::write_table(folder / "series.csv", columns, rows);
    coupling::write_table(folder / "walls.csv", {{"piece", "-"}, {"x", "m"}, {"y", "m"}},
                          {{0, 0, 0}, {0, 1e-5, 1e-6}, {1, 0, 1e-5}, {1, 1e-5, 1e-5}});
  }

  void write_frame(int number, std::int64_t cells) const {
    std::filesystem::create_directories(folder / "frames");
    const micro::TrajectoryLayout layout = sample_layout(cells);
    micro::TrajectoryWriter writer = micro::TrajectoryWriter::create(
        folder / ("frames/cells-00000" + std::to_string(number) + ".h5"), layout);
    append(writer, sample_frame(layout, number));
  }

  ScratchFolder folder{"feed-plot"};
};

TEST_F(FeedPlot, draws_cells_that_come_and_go_and_their_shares) {
  write_series({0, 2, 3});
  write_frame(1, 2);
  write_frame(2, 3);
  ASSERT_EQ(plot(folder.path()), 0);
  EXPECT_TRUE(is_picture(folder / "ensemble-cells.png"));
  EXPECT_TRUE(is_picture(folder / "ensemble-shares.png"));
  EXPECT_FALSE(is_picture(folder / "series.png"));
}

TEST_F(FeedPlot, draws_two_kinds) {
  write_series({0, 1}, {"", "platelets: "});
  write_frame(1, 2);
  ASSERT_EQ(plot(folder.path()), 0);
  EXPECT_TRUE(is_picture(folder / "ensemble-cells.png"));
}

TEST_F(FeedPlot, draws_a_vessel_without_frames) {
  write_series({0});
  ASSERT_EQ(plot(folder.path()), 0);
  EXPECT_FALSE(is_picture(folder / "ensemble-cells.png"));
  EXPECT_TRUE(is_picture(folder / "ensemble-shares.png"));
}

}  // namespace
}  // namespace hemoscale::tests
