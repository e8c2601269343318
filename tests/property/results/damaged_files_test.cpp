#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "micro/error.hpp"
#include "micro/snapshot/checkpoint.hpp"
#include "micro/snapshot/trajectory_file.hpp"
#include "tests/unit/results/sample_trajectory.hpp"
#include "tests/unit/results/scratch_folder.hpp"

namespace hemoscale::tests {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const fs::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

/// The content with one bit changed.
std::string flipped(std::string content, std::size_t byte, unsigned bit) {
  content[byte] = static_cast<char>(static_cast<unsigned char>(content[byte]) ^ (1U << bit));
  return content;
}

TEST(DamagedCheckpoint, is_always_refused) {
  const ScratchFolder folder("damaged-checkpoint");
  micro::Checkpoint checkpoint;
  checkpoint.identity = {{"seed", "7"}};
  checkpoint.slots["model"].reals["positions"] = std::vector<double>(300, 1.5);
  checkpoint.slots["model"].integers["counter"] = {1, 2, 3};
  const fs::path path = write_checkpoint(folder.path(), checkpoint);
  const std::string whole = content_of(path);
  ASSERT_NO_THROW(micro::read_checkpoint(path));

  std::mt19937_64 random(20061);
  for (int trial = 0; trial < 400; ++trial) {
    const std::size_t byte = random() % whole.size();
    const auto bit = static_cast<unsigned>(random() % 8);
    write(path, flipped(whole, byte, bit));
    EXPECT_THROW(micro::read_checkpoint(path), micro::EnvironmentError)
        << "bit " << bit << " of byte " << byte;
    write(path, whole.substr(0, byte));
    EXPECT_THROW(micro::read_checkpoint(path), micro::EnvironmentError) << byte << " bytes left";
  }
  for (std::size_t byte = 0; byte < 512; ++byte) {  // the header, every byte
    write(path, flipped(whole, byte, static_cast<unsigned>(byte % 8)));
    EXPECT_THROW(micro::read_checkpoint(path), micro::EnvironmentError) << "byte " << byte;
  }
  write(path, whole + "more");
  EXPECT_THROW(micro::read_checkpoint(path), micro::EnvironmentError);
  write(path, whole);
  EXPECT_NO_THROW(micro::read_checkpoint(path));
}

/// Reads everything; whether the arrays, which carry checksums, are right wherever they can be
/// read.
bool arrays_are_right(const fs::path& path, int frames) {
  const micro::TrajectoryReader reader(path);
  for (std::int64_t k = 0; k < reader.frame_count(); ++k) {
    const micro::StoredFrame frame = reader.frame(k);
    const micro::StoredFrame expected = sample_frame(sample_layout(), 10 * (k + 1));
    if (k < frames &&
        (frame.positions != expected.positions || frame.velocities != expected.velocities)) {
      return false;
    }
  }
  return true;
}

TEST(DamagedTrajectory, ends_in_an_error_or_in_the_right_arrays) {
  const ScratchFolder folder("damaged-trajectory");
  const fs::path path = folder / "t.h5";
  constexpr int frames = 6;
  {
    micro::TrajectoryWriter writer = micro::TrajectoryWriter::create(path, sample_layout());
    for (std::int64_t k = 1; k <= frames; ++k)
      append(writer, sample_frame(writer.layout(), 10 * k));
  }
  const std::string whole = content_of(path);
  std::mt19937_64 random(20062);
  int errors = 0;
  constexpr int trials = 400;
  for (int trial = 0; trial < trials; ++trial) {
    const std::size_t byte = random() % whole.size();
    const bool is_cut = trial % 4 == 0;
    write(path, is_cut ? whole.substr(0, byte)
                       : flipped(whole, byte, static_cast<unsigned>(random() % 8)));
    try {
      EXPECT_TRUE(arrays_are_right(path, frames)) << (is_cut ? "cut at " : "damaged at ") << byte;
    } catch (const micro::EnvironmentError&) {
      ++errors;
    }
  }
  EXPECT_GE(errors, trials / 4);  // the cuts at least
}

}  // namespace
}  // namespace hemoscale::tests
