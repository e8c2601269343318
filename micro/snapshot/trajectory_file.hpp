#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace hemoscale::micro {

/// A scalar that is stored with every frame.
struct TrajectoryScalar {
  std::string name;  // the name of its group under /observables, e.g. "shear_stress"
  std::string unit;  // in the form of H5MD's units module: "m s-1", "Pa"; empty for a pure number

  friend bool operator==(const TrajectoryScalar&, const TrajectoryScalar&) = default;
};

/// What does not change along a trajectory.
///
/// The nodes of the rings come first, ring after ring, each ring in its own order; particles that
/// belong to no ring follow.
struct TrajectoryLayout {
  std::string particles = "nodes";  // name of the group under /particles
  std::string author = "unknown";   // required by H5MD
  std::string creator = "HemoScale";
  std::string creator_version;
  int dimension = 2;                          // of the positions: 2 or 3
  std::vector<std::int64_t> nodes_per_ring;   // [-] of each ring; at least three
  std::int64_t free_particles = 0;            // [-] that belong to no ring
  std::vector<double> box_edges;              // [m] one per dimension
  std::vector<bool> is_periodic;              // one per dimension
  bool has_velocities = false;                // whether every frame carries velocities
  bool single_precision = false;              // of positions and velocities: half the size on disk
  std::vector<TrajectoryScalar> observables;  // stored with every frame

  std::int64_t particle_count() const;

  friend bool operator==(const TrajectoryLayout&, const TrajectoryLayout&) = default;
};

/// One instant, as it is handed to the writer: views into the caller's arrays.
struct TrajectoryFrame {
  std::int64_t step = 0;               // [-] larger than that of the frame before
  double time = 0;                     // [s]
  std::span<const double> positions;   // [m] particle after particle: x0 y0 x1 y1 ...; every ring
                                       // unwrapped, so that its polyline does not cross the box
  std::span<const double> velocities;  // [m/s] likewise; empty unless the layout has velocities
  double box_offset = 0;               // [m] by which the upper image of a sheared box is displaced
                                       // along the first axis (Lees and Edwards 1972); else 0
  std::span<const double> observables;  // in the order of the layout
};

/// One instant, as it was read.
struct StoredFrame {
  std::int64_t step = 0;            // [-]
  double time = 0;                  // [s]
  std::vector<double> positions;    // [m]
  std::vector<double> velocities;   // [m/s]
  double box_offset = 0;            // [m]
  std::vector<double> observables;  // in the order of the layout
};

/// Writes a trajectory in the H5MD 1.1 layout (de Buyl, Colberg and Höfling 2014) to one HDF5 file.
///
/// Between two calls the file is closed, complete and readable by anyone. Within append() it is
/// written in HDF5's single-writer-multiple-reader order, which updates the index after the data it
/// points to, and steps and times last: a process killed at any moment leaves all earlier frames
/// readable. (If the kill falls within append(), HDF5 tools other than this library may ask for
/// `h5clear -s FILE` first.) Space on disk is reserved before a frame is written, so that a full
/// disk is found while the file is still untouched. One process writes, at one place.
class TrajectoryWriter {
 public:
  /// Starts a new trajectory; an older file of that name is replaced.
  /// @throws ParameterError on an inconsistent layout, EnvironmentError with path and reason
  static TrajectoryWriter create(const std::filesystem::path& path, const TrajectoryLayout& layout);

  /// Continues the trajectory of a run that restarts from the state after `restart_step`. Frames of
  /// later steps are dropped (by way of a copy that replaces the file when it is complete), earlier
  /// ones are kept. Starts a new trajectory if there is no file.
  /// @throws EnvironmentError also if the file is of another layout (authorship apart)
  static TrajectoryWriter resume(const std::filesystem::path& path, const TrajectoryLayout& layout,
                                 std::int64_t restart_step);

  /// Adds one frame; on return it is in the file.
  /// @throws ParameterError if the frame does not fit the layout or its step does not increase;
  ///         EnvironmentError with path and the system's reason, the frames before being intact
  void append(const TrajectoryFrame& frame);

  std::int64_t frame_count() const { return frame_count_; }
  const TrajectoryLayout& layout() const { return layout_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  TrajectoryWriter(std::filesystem::path path, TrajectoryLayout layout, std::int64_t frame_count,
                   std::int64_t last_step);

  std::filesystem::path path_;
  TrajectoryLayout layout_;
  std::int64_t frame_count_ = 0;
  std::int64_t last_step_ = 0;  // of the last frame; meaningless without one
};

/// Reads what TrajectoryWriter wrote; frames that a killed writer left incomplete are not shown.
class TrajectoryReader {
 public:
  /// @throws EnvironmentError with path and reason if the file is missing, damaged or of another
  /// kind
  explicit TrajectoryReader(const std::filesystem::path& path);

  const TrajectoryLayout& layout() const { return layout_; }
  const std::filesystem::path& path() const { return path_; }
  std::int64_t frame_count() const { return static_cast<std::int64_t>(steps_.size()); }
  const std::vector<std::int64_t>& steps() const { return steps_; }  // [-]
  const std::vector<double>& times() const { return times_; }        // [s]

  /// False if a writer was killed while it appended (or is appending now).
  bool is_clean() const { return is_clean_; }

  /// @throws EnvironmentError if the data of that frame are damaged, ParameterError if there is no
  ///         such frame
  StoredFrame frame(std::int64_t index) const;

  /// An observable of all frames, in the unit of the layout.
  /// @param index  in the order of the layout
  std::vector<double> observable(std::size_t index) const;

 private:
  std::filesystem::path path_;
  TrajectoryLayout layout_;
  std::vector<std::int64_t> steps_;
  std::vector<double> times_;
  bool is_clean_ = true;
};

}  // namespace hemoscale::micro
