#include "micro/snapshot/xdmf.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "micro/error.hpp"
#include "tests/unit/results/python_script.hpp"
#include "tests/unit/results/sample_trajectory.hpp"
#include "tests/unit/results/scratch_folder.hpp"

namespace hemoscale::tests {
namespace {

namespace fs = std::filesystem;

micro::TrajectoryLayout layout_of_kind(int kind) {
  micro::TrajectoryLayout layout = sample_layout();
  if (kind == 1) {
    layout.nodes_per_ring = {8, 3, 5};
    layout.free_particles = 4;
    layout.particles = "cells & <platelets>";
    layout.single_precision = true;
  }
  if (kind == 2) {
    layout.nodes_per_ring.clear();
    layout.free_particles = 6;
    layout.has_velocities = false;
    layout.observables.clear();
    layout.dimension = 3;
    layout.box_edges = {1, 2, 3};
    layout.is_periodic = {true, true, true};
  }
  return layout;
}

class Kinds : public testing::TestWithParam<int> {};

TEST_P(Kinds, files_follow_their_formats_also_after_a_move) {
  if (!has_module("h5py")) GTEST_SKIP() << "the Debian package python3-h5py-mpi is not installed";
  const ScratchFolder folder("xdmf");
  fs::create_directories(folder / "made");
  micro::TrajectoryWriter writer =
      micro::TrajectoryWriter::create(folder / "made" / "t.h5", layout_of_kind(GetParam()));
  for (int k = 1; k <= 3; ++k) append(writer, sample_frame(writer.layout(), k));
  EXPECT_EQ(micro::write_xdmf(writer.path()), folder / "made" / "t.xdmf");
  append(writer, sample_frame(writer.layout(), 4));  // what was written stays right
  fs::rename(folder / "made", folder / "moved");
  EXPECT_EQ(run_script("tests/unit/results/check_h5md.py", folder / "moved" / "t.h5"), 0);
  EXPECT_EQ(run_script("tests/unit/results/check_xdmf.py", folder / "moved" / "t.xdmf"), 0);
}

INSTANTIATE_TEST_SUITE_P(Xdmf, Kinds, testing::Values(0, 1, 2));

TEST(Xdmf, of_an_empty_trajectory_has_no_grid) {
  const ScratchFolder folder("xdmf-empty");
  micro::TrajectoryWriter::create(folder / "t.h5", sample_layout());
  EXPECT_NO_THROW(micro::write_xdmf(folder / "t.h5"));
  EXPECT_THROW(micro::write_xdmf(folder / "absent.h5"), micro::EnvironmentError);
}

}  // namespace
}  // namespace hemoscale::tests
