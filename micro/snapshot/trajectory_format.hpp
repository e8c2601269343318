#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "micro/snapshot/hdf5_handle.hpp"
#include "micro/snapshot/trajectory_file.hpp"

// Where what stands in a trajectory file. For the sources of this folder alone.
namespace hemoscale::micro::trajectory_format {

/// Names of the data sets that grow.
struct Names {
  explicit Names(const TrajectoryLayout& layout);

  std::string group;  // /particles/<name>
  std::string step;
  std::string time;
  std::string positions;
  std::string velocities;
  std::string box_offset;
  std::vector<std::string> observables;
};

/// Which particles belong together, as elements of one size: every ring a closed line. A shorter
/// ring repeats its first node, and a free particle itself, up to that size, which no picture
/// shows; ParaView's readers agree on lines of one size only.
struct Topology {
  std::int64_t elements = 0;           // [-] rings and free particles
  std::int64_t nodes_per_element = 1;  // [-] of the largest ring, closed; 1 without rings
  std::vector<std::int64_t> values;    // numbers of particles, element after element
};
Topology topology_of(const TrajectoryLayout& layout);

inline constexpr const char* topology_name = "/parameters/xdmf_topology";
inline constexpr const char* observables_group = "/observables";
inline constexpr const char* box_offset_name = "box_offset";
inline constexpr std::int64_t no_ring = -1;  // ring number of a free particle

/// @throws ParameterError with what is wrong, the value, and what is allowed
void require_consistent(const TrajectoryLayout& layout);

/// What of two layouts differs, for a message; empty if only the authorship does.
std::string difference(const TrajectoryLayout& stored, const TrajectoryLayout& wanted);

/// Writes everything but the frames into a file that is new.
void write_layout(const hdf5::File& file, const TrajectoryLayout& layout);
TrajectoryLayout read_layout(const hdf5::File& file);

hdf5::File make_file(const std::filesystem::path& path);
hdf5::File open_to_append(const std::filesystem::path& path);
hdf5::File open_to_read(const std::filesystem::path& path);

/// Whether the last writer closed the file.
bool is_closed(const std::filesystem::path& path);

/// Frames that are complete: the least extent of all data sets that grow. `is_even` tells whether
/// all have that extent.
struct FrameCount {
  hsize_t complete = 0;
  bool is_even = true;
};
FrameCount count_frames(const hdf5::File& file, const TrajectoryLayout& layout);

}  // namespace hemoscale::micro::trajectory_format
