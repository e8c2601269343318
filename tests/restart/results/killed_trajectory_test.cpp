#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>
#include <utility>

#include "micro/error.hpp"
#include "micro/snapshot/trajectory_file.hpp"
#include "micro/snapshot/trajectory_format.hpp"
#include "tests/restart/results/interrupted_writes.hpp"
#include "tests/unit/results/sample_trajectory.hpp"
#include "tests/unit/results/scratch_folder.hpp"

namespace hemoscale::tests {
namespace {

namespace fs = std::filesystem;
using micro::TrajectoryReader;
using micro::TrajectoryWriter;

/// With scalars enough, the index spreads over many pages.
micro::TrajectoryLayout layout_with(int more_scalars) {
  micro::TrajectoryLayout layout = sample_layout();
  for (int k = 0; k < more_scalars; ++k) {
    layout.observables.push_back({"scalar_" + std::to_string(k), "m"});
  }
  return layout;
}

/// Frames of steps 10, 20, ...
void write_frames(const fs::path& path, std::int64_t count, int more_scalars = 0) {
  TrajectoryWriter writer = TrajectoryWriter::create(path, layout_with(more_scalars));
  for (std::int64_t k = 1; k <= count; ++k) append(writer, sample_frame(writer.layout(), 10 * k));
}

/// Number of frames. Fails the test if the first or one of the last is not as it was written; those
/// between lie in the same parts of the index.
std::int64_t whole_frames(const fs::path& path) {
  const TrajectoryReader reader(path);
  for (std::int64_t k = 0; k < reader.frame_count(); ++k) {
    if (k > 0 && k + 4 < reader.frame_count()) continue;
    EXPECT_TRUE(are_equal(reader.frame(k), sample_frame(reader.layout(), 10 * (k + 1))))
        << "frame " << k;
  }
  return reader.frame_count();
}

/// What another program relies on that takes the number of frames from the steps.
bool every_step_has_its_values(const fs::path& path, const micro::TrajectoryLayout& layout) {
  const micro::hdf5::Silence silence;
  const micro::hdf5::File file = micro::trajectory_format::open_to_read(path);
  const micro::trajectory_format::Names names(layout);
  return file.extent(names.step)[0] ==
         micro::trajectory_format::count_frames(file, layout).complete;
}

/// Frames before the one that is interrupted: few, and such that the index of the chunks or the
/// chunk of the scalars grows.
struct Start {
  std::int64_t frames = 0;
  int more_scalars = 0;
};
void PrintTo(const Start& start, std::ostream* stream) {
  *stream << start.frames << " frames, " << start.more_scalars << " more scalars";
}
class KilledAppend : public testing::TestWithParam<Start> {};

TEST_P(KilledAppend, leaves_all_earlier_frames_readable_and_can_be_continued) {
  const std::int64_t before = GetParam().frames;
  const micro::TrajectoryLayout layout = layout_with(GetParam().more_scalars);
  const ScratchFolder folder("killed-append-" + std::to_string(before));
  const fs::path original = folder / "original.h5";
  write_frames(original, before, GetParam().more_scalars);
  for (const Interruption kill : {Interruption::kill_before, Interruption::kill_within}) {
    int call = 0;
    const int stride = before < 100 ? 1 : 4;  // a long file takes long to copy
    for (bool was_reached = true; was_reached; call += stride) {
      SCOPED_TRACE("kind " + std::to_string(static_cast<int>(kill)) + ", call " +
                   std::to_string(call));
      const fs::path path = folder / "trajectory.h5";
      fs::copy_file(original, path, fs::copy_options::overwrite_existing);
      const Ending ending = interrupt(kill, call, [&] {
        TrajectoryWriter writer = TrajectoryWriter::resume(path, layout, 10 * before);
        append(writer, sample_frame(writer.layout(), 10 * (before + 1)));
        return 0;
      });
      was_reached = ending.was_reached;
      ASSERT_EQ(ending.was_killed, was_reached);
      EXPECT_TRUE(every_step_has_its_values(path, layout));
      const std::int64_t frames = whole_frames(path);
      EXPECT_THAT(frames, testing::AnyOf(before, before + 1));
      if (!was_reached) {
        EXPECT_EQ(frames, before + 1);
      }

      TrajectoryWriter writer = TrajectoryWriter::resume(path, layout, 10 * before);
      ASSERT_EQ(writer.frame_count(), before);
      append(writer, sample_frame(writer.layout(), 10 * (before + 1)));
      EXPECT_EQ(whole_frames(path), before + 1);
      EXPECT_TRUE(TrajectoryReader(path).is_clean());
    }
    EXPECT_GT(call, 8);  // or the writes were not counted
  }
}

INSTANTIATE_TEST_SUITE_P(Frames, KilledAppend,
                         testing::Values(Start{0}, Start{1, 30}, Start{20}, Start{256}));

TEST(KilledTruncation, keeps_the_old_file_or_leaves_the_new_one) {
  const ScratchFolder folder("killed-truncation");
  const fs::path original = folder / "original.h5";
  write_frames(original, 5);
  bool was_reached = true;
  for (int call = 0; was_reached; call += 3) {
    SCOPED_TRACE(call);
    const fs::path path = folder / "trajectory.h5";
    fs::copy_file(original, path, fs::copy_options::overwrite_existing);
    const Ending ending = interrupt(Interruption::kill_within, call, [&] {
      TrajectoryWriter::resume(path, sample_layout(), 20);
      return 0;
    });
    was_reached = ending.was_reached;
    EXPECT_THAT(whole_frames(path), testing::AnyOf(was_reached ? 5 : 2, 2));
  }
}

TEST(FullDisk, append_names_path_and_reason_keeps_the_frames_before_and_can_be_repeated) {
  const ScratchFolder folder("full-disk");
  const fs::path path = folder / "trajectory.h5";
  // The child tells by its exit status what it saw.
  constexpr int no_error = 0;
  constexpr int right_error = 1;
  constexpr int wrong_error = 2;
  constexpr int lasting_error = 3;
  int call = 0;
  for (bool was_reached = true; was_reached; ++call) {
    SCOPED_TRACE(call);
    write_frames(path, 3);
    const Ending ending = interrupt(Interruption::disk_full, call, [&] {
      TrajectoryWriter writer = TrajectoryWriter::resume(path, sample_layout(), 30);
      try {
        append(writer, sample_frame(writer.layout(), 40));
        return no_error;
      } catch (const micro::EnvironmentError& error) {
        const std::string text = error.what();
        if (text.find(path.string()) == std::string::npos ||
            text.find("No space left on device") == std::string::npos) {
          return wrong_error;
        }
      }
      end_interruption();
      try {
        append(writer, sample_frame(writer.layout(), 40));
      } catch (const micro::EnvironmentError&) {
        return lasting_error;
      }
      return right_error;
    });
    was_reached = ending.was_reached;
    ASSERT_FALSE(ending.was_killed);
    if (call == 0 || !was_reached) {
      EXPECT_EQ(ending.exit_status, was_reached ? right_error : no_error);
      EXPECT_EQ(whole_frames(path), 4);
    } else {
      // The first call reserves the space. That a later one fails should not happen, but must not
      // lose anything; that HDF5 then holds on to the file until the process ends is accepted.
      EXPECT_THAT(ending.exit_status, testing::AnyOf(right_error, lasting_error));
      EXPECT_GE(whole_frames(path), 3);
    }
  }
  EXPECT_GT(call, 8);  // or the writes were not counted
}

TEST(FullDisk, a_frame_that_does_not_fit_is_refused_before_the_file_is_touched) {
  const ScratchFolder folder("file-limit");
  const fs::path path = folder / "trajectory.h5";
  for (const rlim_t room : {0U, 100U, 1000U, 10000U}) {  // [byte]
    SCOPED_TRACE(room);
    write_frames(path, 3);
    const rlim_t size = fs::file_size(path);
    const pid_t child = ::fork();
    if (child == 0) {
      std::signal(SIGXFSZ, SIG_IGN);
      rlimit limit{};
      ::getrlimit(RLIMIT_FSIZE, &limit);
      const rlim_t usual = std::exchange(limit.rlim_cur, size + room);
      int status = ::setrlimit(RLIMIT_FSIZE, &limit) == 0 ? 1 : 2;
      TrajectoryWriter writer = TrajectoryWriter::resume(path, sample_layout(), 30);
      try {
        append(writer, sample_frame(writer.layout(), 40));
      } catch (const micro::EnvironmentError& error) {
        const std::string text = error.what();
        if (text.find("trajectory.h5: cannot reserve space for another frame: File too large") !=
            std::string::npos) {
          limit.rlim_cur = usual;
          ::setrlimit(RLIMIT_FSIZE, &limit);
          append(writer, sample_frame(writer.layout(), 40));
          status = 0;
        }
      }
      ::_exit(status);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(whole_frames(path), 4);
  }
}

}  // namespace
}  // namespace hemoscale::tests
