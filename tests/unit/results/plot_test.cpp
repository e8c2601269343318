#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "coupling/report/series.hpp"
#include "coupling/report/summary.hpp"
#include "tests/unit/results/pictures.hpp"
#include "tests/unit/results/python_script.hpp"
#include "tests/unit/results/sample_trajectory.hpp"
#include "tests/unit/results/scratch_folder.hpp"

namespace hemoscale::tests {
namespace {

class Plot : public testing::Test {
 protected:
  void SetUp() override {
    for (const std::string module : {"matplotlib", "h5py"}) {
      if (!has_module(module)) GTEST_SKIP() << "python3-" << module << " is not installed";
    }
  }
  ScratchFolder folder{"plot"};
};

TEST_F(Plot, draws_a_coupled_run) {
  coupling::write_table(folder / "profile.csv",
                        {{"y", "m"}, {"velocity", "m/s"}, {"reference velocity", "m/s"}},
                        {{0, 0, 0}, {5e-5, 1e-3, 1.01e-3}, {1e-4, 0, 0}});
  coupling::write_table(
      folder / "law.csv",
      {{"shear rate", "1/s"}, {"viscosity", "Pa s"}, {"lower", "Pa s"}, {"upper", "Pa s"}},
      {{1, 0.01, std::nan(""), std::nan("")}, {10, 0.006, 0.005, 0.007}, {100, 4e-3, 3e-3, 5e-3}});
  coupling::write_table(
      folder / "samples.csv",
      {{"shear_rate", "1/s"}, {"viscosity", "Pa s"}, {"standard_error", "Pa s"}, {"pass", "-"}},
      {{10, 0.007, 1e-4, 1}, {10, 0.006, 1e-4, 2}});
  coupling::write_table(folder / "series.csv",
                        {{"pass", "-"}, {"change", "-"}, {"relaxation", "-"}, {"micro_runs", "-"}},
                        {{1, 0.1, 1, 4}, {2, 0, 0.5, 4}});
  coupling::Summary summary;
  summary.title = "a title";
  summary.statements = {"2-D"};
  write_summary(folder / "summary.json", summary);
  ASSERT_EQ(plot(folder.path()), 0);
  for (const std::string name : {"profile.png", "law.png", "convergence.png"}) {
    EXPECT_TRUE(is_picture(folder / name)) << name;
  }
}

TEST_F(Plot, draws_a_micro_run) {
  coupling::write_table(folder / "series.csv", {{"time", "s"}, {"shear stress", "Pa"}},
                        {{0, 1}, {1, 2}});
  micro::TrajectoryLayout layout = sample_layout();
  layout.is_periodic[1] = true;
  layout.free_particles = 2;
  micro::TrajectoryWriter writer =
      micro::TrajectoryWriter::create(folder / "trajectory.h5", layout);
  append(writer, sample_frame(layout, 1));
  append(writer, sample_frame(layout, 2));
  ASSERT_EQ(plot(folder.path()), 0);
  EXPECT_TRUE(is_picture(folder / "series.png"));
  EXPECT_TRUE(is_picture(folder / "cells.png"));
}

TEST_F(Plot, draws_nothing_of_nothing_and_refuses_broken_tables) {
  EXPECT_EQ(plot(folder.path()), 0);
  EXPECT_NE(plot(folder / "absent"), 0);
  std::ofstream(folder / "law.csv") << "shear rate [1/s],viscosity [Pa s]\n1,abc\n";
  EXPECT_NE(plot(folder.path()), 0);
}

}  // namespace
}  // namespace hemoscale::tests
