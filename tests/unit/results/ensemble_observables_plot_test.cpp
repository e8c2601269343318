#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "coupling/report/series.hpp"
#include "tests/unit/results/pictures.hpp"
#include "tests/unit/results/python_script.hpp"
#include "tests/unit/results/sample_trajectory.hpp"
#include "tests/unit/results/scratch_folder.hpp"

namespace hemoscale::tests {
namespace {

class EnsemblePlot : public testing::Test {
 protected:
  void SetUp() override {
    for (const std::string module : {"matplotlib", "h5py"}) {
      if (!has_module(module)) GTEST_SKIP() << "python3-" << module << " is not installed";
    }
  }

  /// Columns that every ensemble has, whatever its channel.
  void write_series(const std::vector<double>& times) const {
    std::vector<coupling::Column> columns = {{"time", "s"}};
    for (const std::string name :
         {"cells", "orientational order", "order along the flow", "mean deformation",
          "share of cells in contact", "mean coordination", "largest area strain",
          "largest perimeter strain"}) {
      columns.push_back({name, "-"});
    }
    columns.push_back({"cell area through upper daughter", "m^2"});
    std::vector<std::vector<double>> rows;
    for (const double time : times) {
      rows.push_back({time, 2, 0.3, 0.2, 0.5, 0.4, 2, 0.01, 0.05, 1e-10});
    }
    coupling::write_table(folder / "series.csv", columns, rows);
  }

  void write_trajectory(int frames) const {
    const micro::TrajectoryLayout layout = sample_layout();
    micro::TrajectoryWriter writer =
        micro::TrajectoryWriter::create(folder / "trajectory.h5", layout);
    for (int k = 1; k <= frames; ++k) append(writer, sample_frame(layout, k));
  }

  ScratchFolder folder{"ensemble-plot"};
};

TEST_F(EnsemblePlot, draws_what_there_is_of_a_crooked_channel) {
  write_series({0, 0.1, 0.2});
  write_trajectory(2);
  coupling::write_table(folder / "walls.csv", {{"piece", "-"}, {"x", "m"}, {"y", "m"}},
                        {{0, 0, 0}, {0, 1e-5, 1e-6}, {1, 0, 1e-5}, {1, 1e-5, 1e-5}});
  ASSERT_EQ(plot(folder.path()), 0);
  EXPECT_TRUE(is_picture(folder / "ensemble-cells.png"));
  EXPECT_TRUE(is_picture(folder / "ensemble-series.png"));
  EXPECT_FALSE(is_picture(folder / "ensemble-concentration.png"));
  EXPECT_FALSE(is_picture(folder / "series.png"));  // it would have a panel for each column
}

TEST_F(EnsemblePlot, draws_a_run_of_one_row) {
  write_series({0});
  write_trajectory(1);
  ASSERT_EQ(plot(folder.path()), 0);
  EXPECT_TRUE(is_picture(folder / "ensemble-cells.png"));
  EXPECT_TRUE(is_picture(folder / "ensemble-series.png"));
}

TEST_F(EnsemblePlot, draws_without_a_trajectory) {
  write_series({0, 0.1});
  ASSERT_EQ(plot(folder.path()), 0);
  EXPECT_TRUE(is_picture(folder / "ensemble-series.png"));
  EXPECT_FALSE(is_picture(folder / "ensemble-cells.png"));
}

}  // namespace
}  // namespace hemoscale::tests
