#include "micro/snapshot/trajectory_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "micro/error.hpp"
#include "tests/unit/results/sample_trajectory.hpp"
#include "tests/unit/results/scratch_folder.hpp"

namespace hemoscale::tests {
namespace {

namespace fs = std::filesystem;
using micro::TrajectoryLayout;
using micro::TrajectoryReader;
using micro::TrajectoryWriter;
using testing::ElementsAre;
using testing::HasSubstr;

void write_frames(const fs::path& path, const TrajectoryLayout& layout, int count) {
  TrajectoryWriter writer = TrajectoryWriter::create(path, layout);
  for (std::int64_t k = 1; k <= count; ++k) append(writer, sample_frame(layout, 10 * k));
}

TrajectoryLayout plain_layout() {
  TrajectoryLayout layout = sample_layout();
  layout.has_velocities = false;
  layout.observables.clear();
  return layout;
}

TrajectoryLayout uneven_layout() {
  TrajectoryLayout layout = sample_layout();
  layout.nodes_per_ring = {8, 3, 5};
  layout.free_particles = 4;
  // Neither alphabetical nor reversed: the order must be kept.
  layout.observables = {{"b", "m s-1"}, {"c", ""}, {"a", "Pa"}};
  return layout;
}

TrajectoryLayout free_layout() {
  TrajectoryLayout layout = sample_layout();
  layout.nodes_per_ring.clear();
  layout.free_particles = 40000;  // more than one chunk
  layout.dimension = 3;
  layout.box_edges = {1, 2, 3};
  layout.is_periodic = {true, true, true};
  return layout;
}

struct Kind {
  const char* name;
  std::function<TrajectoryLayout()> layout;
};
void PrintTo(const Kind& kind, std::ostream* stream) {
  *stream << kind.name;
}

class Layouts : public testing::TestWithParam<Kind> {};

TEST_P(Layouts, are_read_back_as_written) {
  const TrajectoryLayout layout = GetParam().layout();
  const ScratchFolder folder("trajectory-layout");
  const fs::path path = folder / "t.h5";
  write_frames(path, layout, 3);
  const TrajectoryReader reader(path);
  EXPECT_TRUE(reader.layout() == layout);
  EXPECT_TRUE(reader.is_clean());
  EXPECT_THAT(reader.steps(), ElementsAre(10, 20, 30));
  EXPECT_THAT(reader.times(), ElementsAre(0.1 * 10, 0.1 * 20, 0.1 * 30));
  for (std::int64_t k = 0; k < 3; ++k) {
    EXPECT_TRUE(are_equal(reader.frame(k), sample_frame(layout, 10 * (k + 1))));
  }
  for (std::size_t n = 0; n < layout.observables.size(); ++n) {
    EXPECT_THAT(reader.observable(n), ElementsAre(10 / (1.0 + static_cast<double>(n)),
                                                  20 / (1.0 + static_cast<double>(n)),
                                                  30 / (1.0 + static_cast<double>(n))));
  }
  EXPECT_THROW(reader.frame(3), micro::ParameterError);
  EXPECT_THROW(reader.frame(-1), micro::ParameterError);
  EXPECT_THROW(reader.observable(layout.observables.size()), micro::ParameterError);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Layouts,
                         testing::Values(Kind{"rings", [] { return sample_layout(); }},
                                         Kind{"plain", plain_layout}, Kind{"uneven", uneven_layout},
                                         Kind{"free particles", free_layout}));

TEST(Trajectory, single_precision_rounds_and_halves_the_size) {
  const ScratchFolder folder("trajectory-single");
  TrajectoryLayout layout = sample_layout(100, 50);
  write_frames(folder / "double.h5", layout, 4);
  layout.single_precision = true;
  write_frames(folder / "single.h5", layout, 4);
  const std::vector<double> exact = sample_frame(layout, 40).positions;
  const std::vector<double> read = TrajectoryReader(folder / "single.h5").frame(3).positions;
  ASSERT_EQ(read.size(), exact.size());
  for (std::size_t k = 0; k < exact.size(); ++k) {
    EXPECT_EQ(read[k], static_cast<double>(static_cast<float>(exact[k])));
  }
  const auto saved = static_cast<double>(fs::file_size(folder / "double.h5")) -
                     static_cast<double>(fs::file_size(folder / "single.h5"));
  EXPECT_NEAR(saved / (4 * 2 * 5000 * 2 * 4), 1, 0.15);
}

TEST(Trajectory, an_open_file_is_readable_after_every_frame) {
  const ScratchFolder folder("trajectory-live");
  const fs::path path = folder / "t.h5";
  TrajectoryWriter writer = TrajectoryWriter::create(path, sample_layout());
  EXPECT_EQ(TrajectoryReader(path).frame_count(), 0);
  for (int k = 1; k <= 3; ++k) {
    append(writer, sample_frame(writer.layout(), k));
    const TrajectoryReader reader(path);
    EXPECT_EQ(reader.frame_count(), k);
    EXPECT_TRUE(reader.is_clean());
  }
}

TEST(Trajectory, a_restart_drops_later_frames_and_keeps_earlier_ones) {
  const ScratchFolder folder("trajectory-restart");
  const fs::path path = folder / "t.h5";
  struct Expectation {
    std::int64_t restart_step;
    int kept;
  };
  for (const Expectation& expected :
       {Expectation{0, 0}, {9, 0}, {10, 1}, {25, 2}, {50, 5}, {1000, 5}}) {
    SCOPED_TRACE(expected.restart_step);
    write_frames(path, sample_layout(), 5);
    TrajectoryLayout layout = sample_layout();
    layout.creator_version = "2.0.0";  // a newer program may continue
    TrajectoryWriter writer = TrajectoryWriter::resume(path, layout, expected.restart_step);
    EXPECT_EQ(writer.frame_count(), expected.kept);
    EXPECT_EQ(TrajectoryReader(path).frame_count(), expected.kept);
    append(writer, sample_frame(layout, 2000));
    const TrajectoryReader reader(path);
    ASSERT_EQ(reader.frame_count(), expected.kept + 1);
    for (std::int64_t k = 0; k < expected.kept; ++k) {
      EXPECT_TRUE(are_equal(reader.frame(k), sample_frame(layout, 10 * (k + 1))));
    }
    EXPECT_TRUE(are_equal(reader.frame(expected.kept), sample_frame(layout, 2000)));
    EXPECT_FALSE(fs::exists(folder / "t.h5.part"));
  }
}

TEST(Trajectory, a_restart_without_a_file_starts_one) {
  const ScratchFolder folder("trajectory-new");
  EXPECT_EQ(TrajectoryWriter::resume(folder / "sub" / "t.h5", sample_layout(), 10).frame_count(),
            0);
  EXPECT_EQ(TrajectoryReader(folder / "sub" / "t.h5").frame_count(), 0);
}

TEST(Trajectory, of_another_layout_is_not_continued) {
  const ScratchFolder folder("trajectory-other");
  const fs::path path = folder / "t.h5";
  write_frames(path, sample_layout(), 2);
  const std::vector<std::function<void(TrajectoryLayout&)>> changes{
      [](auto& layout) { layout.nodes_per_ring.push_back(8); },
      [](auto& layout) { layout.box_edges[0] *= 2; },
      [](auto& layout) { layout.is_periodic[1] = true; },
      [](auto& layout) { layout.observables[0].unit = "N m-2"; },
      [](auto& layout) { layout.single_precision = true; },
      [](auto& layout) { layout.has_velocities = false; },
      [](auto& layout) { layout.free_particles = 1; },
      [](auto& layout) { layout.particles = "plasma"; }};
  for (const auto& change : changes) {
    TrajectoryLayout layout = sample_layout();
    change(layout);
    EXPECT_THROW(TrajectoryWriter::resume(path, layout, 10), micro::EnvironmentError);
  }
  EXPECT_EQ(TrajectoryReader(path).frame_count(), 2);
}

TEST(Trajectory, inconsistent_layouts_are_refused) {
  const ScratchFolder folder("trajectory-refused");
  const std::vector<std::function<void(TrajectoryLayout&)>> faults{
      [](auto& layout) { layout.nodes_per_ring[1] = 2; },
      [](auto& layout) { layout.dimension = 4; },
      [](auto& layout) { layout.box_edges.pop_back(); },
      [](auto& layout) { layout.is_periodic.push_back(true); },
      [](auto& layout) { layout.box_edges[1] = 0; },
      [](auto& layout) { layout.nodes_per_ring.clear(); },
      [](auto& layout) { layout.free_particles = -1; },
      [](auto& layout) { layout.particles = "a/b"; },
      [](auto& layout) { layout.particles = ""; },
      [](auto& layout) { layout.observables[1].name = layout.observables[0].name; },
      [](auto& layout) { layout.observables[1].name = "box_offset"; }};
  for (std::size_t k = 0; k < faults.size(); ++k) {
    TrajectoryLayout layout = sample_layout();
    faults[k](layout);
    EXPECT_THROW(TrajectoryWriter::create(folder / "t.h5", layout), micro::ParameterError) << k;
    EXPECT_FALSE(fs::exists(folder / "t.h5"));
  }
}

TEST(Trajectory, frames_that_do_not_fit_are_refused_and_change_nothing) {
  const ScratchFolder folder("trajectory-frames");
  const fs::path path = folder / "t.h5";
  TrajectoryWriter writer = TrajectoryWriter::create(path, sample_layout());
  append(writer, sample_frame(writer.layout(), 10));
  micro::StoredFrame frame = sample_frame(writer.layout(), 10);
  EXPECT_THROW(append(writer, frame), micro::ParameterError);  // the step does not increase
  frame = sample_frame(writer.layout(), 20);
  frame.positions.pop_back();
  EXPECT_THROW(append(writer, frame), micro::ParameterError);
  frame = sample_frame(writer.layout(), 20);
  frame.velocities.clear();
  EXPECT_THROW(append(writer, frame), micro::ParameterError);
  frame = sample_frame(writer.layout(), 20);
  frame.observables.push_back(0);
  EXPECT_THROW(append(writer, frame), micro::ParameterError);
  EXPECT_EQ(TrajectoryReader(path).frame_count(), 1);
}

TEST(Trajectory, failures_name_path_and_reason) {
  const ScratchFolder folder("trajectory-errors");
  std::ofstream(folder / "text.h5") << "this is no HDF5 file\n";
  const auto message = [](auto&& call) -> std::string {
    try {
      call();
    } catch (const micro::EnvironmentError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message([&] { TrajectoryReader(folder / "absent.h5"); }),
              HasSubstr("absent.h5: cannot open: No such file or directory"));
  EXPECT_THAT(message([&] { TrajectoryReader(folder / "text.h5"); }), HasSubstr("text.h5: "));
  EXPECT_THAT(
      message([&] { TrajectoryWriter::create(folder / "text.h5" / "t.h5", sample_layout()); }),
      HasSubstr("Not a directory"));
  EXPECT_THAT(message([&] { TrajectoryWriter::resume(folder / "text.h5", sample_layout(), 1); }),
              HasSubstr("text.h5: "));
  TrajectoryWriter writer = TrajectoryWriter::create(folder / "t.h5", sample_layout());
  fs::remove(folder / "t.h5");
  EXPECT_THAT(message([&] { append(writer, sample_frame(writer.layout(), 1)); }),
              HasSubstr("t.h5: cannot open for appending: No such file or directory"));
}

}  // namespace
}  // namespace hemoscale::tests
