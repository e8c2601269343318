#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "coupling/report/series.hpp"
#include "coupling/report/summary.hpp"
#include "tests/unit/results/pictures.hpp"
#include "tests/unit/results/scratch_folder.hpp"

namespace hemoscale::tests {
namespace {

namespace fs = std::filesystem;
using Rows = std::vector<std::vector<double>>;

const std::vector<coupling::Column> cell_columns = {{"time", "s"}, {"cell", "-"},     {"node", "-"},
                                                    {"x", "m"},    {"y", "m"},        {"u", "m/s"},
                                                    {"v", "m/s"},  {"tension", "N/m"}};
const std::vector<coupling::Column> flow_columns = {
    {"x", "m"}, {"y", "m"}, {"u", "m/s"}, {"v", "m/s"}, {"p", "Pa"}};

class CellPlot : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_module("matplotlib")) GTEST_SKIP() << "python3-matplotlib is not installed";
  }

  // Round cells of 20 nodes that move along the axis of a channel.
  Rows cells(int count, double speed) const {
    Rows rows;
    for (int frame = 0; frame < 5; ++frame) {
      for (int cell = 0; cell < count; ++cell) {
        for (int node = 0; node < 20; ++node) {
          const double angle = 2 * std::numbers::pi * node / 20;
          const double x = 5e-6 + 9e-6 * cell + speed * 0.01 * frame + 3e-6 * std::cos(angle);
          rows.push_back({0.01 * frame, 1.0 * cell, 1.0 * node, x, 5e-6 + 3e-6 * std::sin(angle),
                          speed, 0, 1e-6 * (1 + std::cos(angle))});
        }
      }
    }
    return rows;
  }

  // Plane channel flow with a hole, on a grid of 41 by 11 points.
  Rows flow() const {
    Rows rows;
    for (int i = 0; i <= 40; ++i) {
      for (int j = 0; j <= 10; ++j) {
        const double eta = 0.2 * j - 1;
        const bool is_outside = i == 3 && j == 3;
        rows.push_back({2e-6 * i, 1e-6 * j, 1e-3 * (1 - eta * eta), is_outside ? std::nan("") : 0,
                        0.1 * (40 - i)});
      }
    }
    return rows;
  }

  void write_channel(int count, double speed) const {
    coupling::write_table(folder / "cells.csv", cell_columns, cells(count, speed));
    coupling::write_table(folder / "walls.csv", {{"piece", "-"}, {"x", "m"}, {"y", "m"}},
                          {{0, 0, 0}, {0, 8e-5, 0}, {1, 0, 1e-5}, {1, 8e-5, 1e-5}});
    coupling::write_table(folder / "flow-0001.csv", flow_columns, flow());
  }

  ScratchFolder folder{"cell-plot"};
};

TEST_F(CellPlot, draws_cells_that_travel) {
  write_channel(2, 1e-3);
  coupling::write_table(
      folder / "series.csv",
      {{"time", "s"},
       {"cell 0: velocity along the flow", "m/s"},
       {"cell 1: velocity along the flow", "m/s"},
       {"extra pressure drop", "Pa"}},
      {{0, 1e-3, 1.1e-3, 0.1}, {0.02, 1.2e-3, 1.2e-3, 0.2}, {0.04, 1.2e-3, 1.2e-3, 0.2}});
  coupling::Summary summary;
  summary.title = "a title";
  summary.figures = {{"mean speed", 1e-3, "m/s"},
                     {"cell 0: velocity along the flow", 1.2e-3, "m/s"},
                     {"cell 0: settling time of velocity along the flow", 0.02, "s"},
                     {"cell 1: settling time of velocity along the flow", std::nan(""), "s"}};
  write_summary(folder / "summary.json", summary);
  ASSERT_EQ(plot(folder.path()), 0);
  for (const std::string name :
       {"cell-shapes.png", "cell-flow.png", "cell-series.png", "series.png"}) {
    EXPECT_TRUE(is_picture(folder / name)) << name;
  }
}

TEST_F(CellPlot, draws_a_cell_that_turns_in_its_place) {
  coupling::write_table(folder / "cells.csv", cell_columns, cells(1, 0));
  coupling::write_table(folder / "flow.csv", flow_columns, flow());
  coupling::write_table(folder / "series.csv",
                        {{"time", "s"}, {"strain", "-"}, {"cell 0: inclination", "rad"}},
                        {{0, 0, 0.1}, {0.02, 2, 0.3}, {0.04, 4, 0.4}});
  ASSERT_EQ(plot(folder.path()), 0);
  for (const std::string name : {"cell-shapes.png", "cell-flow.png", "cell-series.png"}) {
    EXPECT_TRUE(is_picture(folder / name)) << name;
  }
}

TEST_F(CellPlot, draws_no_flow_without_its_table) {
  coupling::write_table(folder / "cells.csv", cell_columns, cells(1, 1e-3));
  ASSERT_EQ(plot(folder.path()), 0);
  EXPECT_TRUE(is_picture(folder / "cell-shapes.png"));
  EXPECT_FALSE(fs::exists(folder / "cell-flow.png"));
  EXPECT_FALSE(fs::exists(folder / "cell-series.png"));
}

TEST_F(CellPlot, refuses_frames_without_all_cells) {
  Rows rows = cells(2, 1e-3);
  rows.resize(rows.size() - 20);
  coupling::write_table(folder / "cells.csv", cell_columns, rows);
  EXPECT_NE(plot(folder.path()), 0);
}

TEST_F(CellPlot, refuses_a_grid_with_missing_points) {
  write_channel(1, 1e-3);
  Rows rows = flow();
  rows.pop_back();
  coupling::write_table(folder / "flow-0001.csv", flow_columns, rows);
  EXPECT_NE(plot(folder.path()), 0);
}

TEST_F(CellPlot, refuses_a_table_without_a_column) {
  coupling::write_table(folder / "cells.csv", {{"time", "s"}, {"cell", "-"}, {"node", "-"}},
                        {{0, 0, 0}});
  EXPECT_NE(plot(folder.path()), 0);
}

}  // namespace
}  // namespace hemoscale::tests
