#include "micro/snapshot/trajectory_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <system_error>
#include <utility>

#include "micro/error.hpp"
#include "micro/snapshot/durable_file.hpp"
#include "micro/snapshot/trajectory_format.hpp"

namespace hemoscale::micro {
namespace {

using hdf5::check;
using hdf5::File;
using hdf5::Handle;
using trajectory_format::Names;

Handle open_set(const File& file, const std::string& name) {
  return {check(H5Dopen2(file.id(), name.c_str(), H5P_DEFAULT), file.path(), "open " + name),
          H5Dclose};
}

/// The part of a growing data set that belongs to one frame, with a memory space of that size.
struct FrameSpace {
  Handle in_file;
  Handle in_memory;
};

FrameSpace select_frame(const File& file, const Handle& set, hsize_t index,
                        const std::string& name) {
  const std::string action = fmt::format("find frame {} of {}", index, name);
  Handle space(check(H5Dget_space(set.id()), file.path(), action), H5Sclose);
  const int rank = check(H5Sget_simple_extent_ndims(space.id()), file.path(), action);
  std::vector<hsize_t> count(static_cast<std::size_t>(rank));
  check(H5Sget_simple_extent_dims(space.id(), count.data(), nullptr), file.path(), action);
  std::vector<hsize_t> start(count.size(), 0);
  start[0] = index;
  count[0] = 1;
  check(
      H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
      file.path(), action);
  Handle memory(check(H5Screate_simple(rank, count.data(), nullptr), file.path(), action),
                H5Sclose);
  return {std::move(space), std::move(memory)};
}

/// Writes the values of one frame, extending the data set by it.
void write_values(const File& file, const std::string& name, hsize_t index, hid_t type,
                  const void* values) {
  const std::string action = fmt::format("write frame {} of {}", index, name);
  const Handle set = open_set(file, name);
  std::vector<hsize_t> extent = file.extent(name);
  extent[0] = index + 1;
  check(H5Dset_extent(set.id(), extent.data()), file.path(), action);
  const FrameSpace space = select_frame(file, set, index, name);
  check(H5Dwrite(set.id(), type, space.in_memory.id(), space.in_file.id(), H5P_DEFAULT, values),
        file.path(), action);
  // One data set after the other: what write_frame() writes last is the last on the disk.
  check(H5Dflush(set.id()), file.path(), action);
}

void write_frame(const File& file, const TrajectoryLayout& layout, hsize_t index,
                 const TrajectoryFrame& frame) {
  const Names names(layout);
  write_values(file, names.positions, index, H5T_NATIVE_DOUBLE, frame.positions.data());
  if (layout.has_velocities) {
    write_values(file, names.velocities, index, H5T_NATIVE_DOUBLE, frame.velocities.data());
  }
  write_values(file, names.box_offset, index, H5T_NATIVE_DOUBLE, &frame.box_offset);
  for (std::size_t k = 0; k < names.observables.size(); ++k) {
    write_values(file, names.observables[k], index, H5T_NATIVE_DOUBLE, &frame.observables[k]);
  }
  // Last, so that a step that is listed has all its values.
  write_values(file, names.time, index, H5T_NATIVE_DOUBLE, &frame.time);
  write_values(file, names.step, index, H5T_NATIVE_INT64, &frame.step);
}

void read_values(const File& file, const std::string& name, hsize_t index, hid_t type,
                 void* values) {
  const Handle set = open_set(file, name);
  const FrameSpace space = select_frame(file, set, index, name);
  check(H5Dread(set.id(), type, space.in_memory.id(), space.in_file.id(), H5P_DEFAULT, values),
        file.path(), fmt::format("read frame {} of {}", index, name));
}

/// All of a frame but its step and time.
StoredFrame read_frame(const File& file, const TrajectoryLayout& layout, hsize_t index) {
  const Names names(layout);
  const auto values = static_cast<std::size_t>(layout.particle_count() * layout.dimension);
  StoredFrame frame;
  frame.positions.resize(values);
  read_values(file, names.positions, index, H5T_NATIVE_DOUBLE, frame.positions.data());
  if (layout.has_velocities) {
    frame.velocities.resize(values);
    read_values(file, names.velocities, index, H5T_NATIVE_DOUBLE, frame.velocities.data());
  }
  read_values(file, names.box_offset, index, H5T_NATIVE_DOUBLE, &frame.box_offset);
  frame.observables.resize(layout.observables.size());
  for (std::size_t k = 0; k < names.observables.size(); ++k) {
    read_values(file, names.observables[k], index, H5T_NATIVE_DOUBLE, &frame.observables[k]);
  }
  return frame;
}

/// The first `count` values of a scalar.
template <typename Value>
std::vector<Value> read_series(const File& file, const std::string& name, hid_t type,
                               hsize_t count) {
  std::vector<Value> values(file.extent(name).at(0));
  if (!values.empty()) file.read(name, type, values.data());
  values.resize(count);
  return values;
}

/// Replaces a trajectory by one that holds its first `count` frames.
void copy_frames(const TrajectoryReader& stored, std::size_t count) {
  const hdf5::Silence silence;
  PartFile part(stored.path());
  const File source = trajectory_format::open_to_read(stored.path());
  File target = trajectory_format::make_file(part.path());
  trajectory_format::write_layout(target, stored.layout());
  for (std::size_t k = 0; k < count; ++k) {
    const StoredFrame frame = read_frame(source, stored.layout(), k);
    write_frame(target, stored.layout(), k,
                {stored.steps()[k], stored.times()[k], frame.positions, frame.velocities,
                 frame.box_offset, frame.observables});
  }
  target.close();
  part.move_into_place();
}

/// Makes sure of `bytes` on the disk behind the end of the file. When the disk becomes full while
/// HDF5 writes, it holds on to the file until the process ends, and nothing can be added after room
/// was made; so this must be found before.
void reserve_space(const std::filesystem::path& path, std::int64_t bytes) {
  const auto fail = [&](const char* action, int error) {
    throw EnvironmentError(path.string() + ": cannot " + action + ": " +
                           std::generic_category().message(error));
  };
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail("open for appending", errno);
  struct stat status = {};
  int error = ::fstat(descriptor, &status) == 0 ? 0 : errno;
  if (error == 0) {
    error = ::posix_fallocate(descriptor, status.st_size, bytes);
    // A reservation that failed half-way is given back; what cannot be given back does no harm.
    if (error != 0 && ::ftruncate(descriptor, status.st_size) != 0) errno = 0;
  }
  ::close(descriptor);
  if (error != 0) fail("reserve space for another frame", error);
}

/// An upper bound of what a frame adds to the file: its values, the chunks of the scalars, and the
/// index, whose blocks grow with the root of the number of frames.
std::int64_t bytes_of_frame(const TrajectoryLayout& layout, std::int64_t frames) {
  constexpr std::int64_t per_set = std::int64_t{16} * 1024;
  const auto sets = static_cast<std::int64_t>(layout.observables.size()) + 5;
  const std::int64_t arrays = layout.has_velocities ? 2 : 1;
  const std::int64_t real = layout.single_precision ? 4 : 8;
  const auto root = static_cast<std::int64_t>(std::sqrt(static_cast<double>(frames)));
  return arrays * (layout.particle_count() * layout.dimension * real) +
         sets * (per_set + 256 * root);
}

}  // namespace

std::int64_t TrajectoryLayout::particle_count() const {
  return std::accumulate(nodes_per_ring.begin(), nodes_per_ring.end(), free_particles);
}

TrajectoryWriter::TrajectoryWriter(std::filesystem::path path, TrajectoryLayout layout,
                                   std::int64_t frame_count, std::int64_t last_step)
    : path_(std::move(path)),
      layout_(std::move(layout)),
      frame_count_(frame_count),
      last_step_(last_step) {}

TrajectoryWriter TrajectoryWriter::create(const std::filesystem::path& path,
                                          const TrajectoryLayout& layout) {
  trajectory_format::require_consistent(layout);
  const hdf5::Silence silence;
  PartFile part(path);
  File file = trajectory_format::make_file(part.path());
  trajectory_format::write_layout(file, layout);
  file.close();
  part.move_into_place();
  return {path, layout, 0, 0};
}

TrajectoryWriter TrajectoryWriter::resume(const std::filesystem::path& path,
                                          const TrajectoryLayout& layout,
                                          std::int64_t restart_step) {
  trajectory_format::require_consistent(layout);
  if (!std::filesystem::exists(path)) return create(path, layout);

  const TrajectoryReader stored(path);
  if (const std::string what = trajectory_format::difference(stored.layout(), layout);
      !what.empty()) {
    throw EnvironmentError(
        path.string() + ": cannot continue this trajectory: it differs from that of the run in: " +
        what + "; restart with the settings it was written with, or move it away");
  }
  const std::vector<std::int64_t>& steps = stored.steps();
  const auto kept = std::upper_bound(steps.begin(), steps.end(), restart_step) - steps.begin();
  const std::int64_t last_step = kept > 0 ? steps[static_cast<std::size_t>(kept) - 1] : 0;
  if (stored.is_clean() && kept == stored.frame_count()) {
    return {path, stored.layout(), kept, last_step};
  }
  copy_frames(stored, static_cast<std::size_t>(kept));
  return {path, stored.layout(), kept, last_step};
}

void TrajectoryWriter::append(const TrajectoryFrame& frame) {
  const auto values = static_cast<std::size_t>(layout_.particle_count() * layout_.dimension);
  const auto require = [&](bool is_met, const std::string& message) {
    if (!is_met) throw ParameterError(path_.string() + ": " + message);
  };
  require(
      frame.positions.size() == values,
      fmt::format("a frame has {} coordinates; the layout has {}", frame.positions.size(), values));
  const std::size_t velocities = layout_.has_velocities ? values : 0;
  require(frame.velocities.size() == velocities,
          fmt::format("a frame has {} components of velocity; the layout has {}",
                      frame.velocities.size(), velocities));
  require(frame.observables.size() == layout_.observables.size(),
          fmt::format("a frame has {} observables; the layout has {}", frame.observables.size(),
                      layout_.observables.size()));
  require(frame_count_ == 0 || frame.step > last_step_,
          fmt::format("a frame is of step {} but the one before of step {}; steps must increase",
                      frame.step, last_step_));

  const hdf5::Silence silence;
  reserve_space(path_, bytes_of_frame(layout_, frame_count_));
  File file = trajectory_format::open_to_append(path_);
  write_frame(file, layout_, static_cast<hsize_t>(frame_count_), frame);
  file.close();
  ++frame_count_;
  last_step_ = frame.step;
}

TrajectoryReader::TrajectoryReader(const std::filesystem::path& path) : path_(path) {
  const hdf5::Silence silence;
  // Asked first: HDF5 would answer from the file that it has open.
  const bool was_closed = trajectory_format::is_closed(path);
  const File file = trajectory_format::open_to_read(path);
  layout_ = trajectory_format::read_layout(file);
  const trajectory_format::FrameCount count = trajectory_format::count_frames(file, layout_);
  const Names names(layout_);
  steps_ = read_series<std::int64_t>(file, names.step, H5T_NATIVE_INT64, count.complete);
  times_ = read_series<double>(file, names.time, H5T_NATIVE_DOUBLE, count.complete);
  if (std::adjacent_find(steps_.begin(), steps_.end(), std::greater_equal<>{}) != steps_.end()) {
    throw EnvironmentError(path.string() + ": its steps do not increase; the file is damaged");
  }
  is_clean_ = count.is_even && was_closed;
}

StoredFrame TrajectoryReader::frame(std::int64_t index) const {
  if (index < 0 || index >= frame_count()) {
    throw ParameterError(fmt::format("{}: frame {} was asked for; there are {}", path_.string(),
                                     index, frame_count()));
  }
  const hdf5::Silence silence;
  const auto at = static_cast<std::size_t>(index);
  StoredFrame frame = read_frame(trajectory_format::open_to_read(path_), layout_, at);
  frame.step = steps_[at];
  frame.time = times_[at];
  return frame;
}

std::vector<double> TrajectoryReader::observable(std::size_t index) const {
  if (index >= layout_.observables.size()) {
    throw ParameterError(fmt::format("{}: observable {} was asked for; there are {}",
                                     path_.string(), index, layout_.observables.size()));
  }
  const hdf5::Silence silence;
  const File file = trajectory_format::open_to_read(path_);
  return read_series<double>(file, Names(layout_).observables[index], H5T_NATIVE_DOUBLE,
                             steps_.size());
}

}  // namespace hemoscale::micro
