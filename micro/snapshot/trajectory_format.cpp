#include "micro/snapshot/trajectory_format.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "micro/error.hpp"

namespace hemoscale::micro::trajectory_format {
namespace {

using hdf5::check;
using hdf5::File;
using hdf5::Handle;

/// Access that does not depend on locks, which some network file systems lack: one process writes,
/// and who reads meanwhile does no harm.
Handle file_access(const std::filesystem::path& path) {
  Handle access(check(H5Pcreate(H5P_FILE_ACCESS), path, "open"), H5Pclose);
  check(H5Pset_libver_bounds(access.id(), H5F_LIBVER_V110, H5F_LIBVER_V110), path, "open");
  check(H5Pset_file_locking(access.id(), false, true), path, "open");
  // HDF5 waits for a checksum to come right, as a living writer would make it; ours is dead.
  check(H5Pset_metadata_read_attempts(access.id(), 1), path, "open");
  return access;
}

}  // namespace

Names::Names(const TrajectoryLayout& layout)
    : group("/particles/" + layout.particles),
      step(group + "/position/step"),
      time(group + "/position/time"),
      positions(group + "/position/value"),
      velocities(group + "/velocity/value"),
      box_offset(std::string(observables_group) + "/" + box_offset_name + "/value") {
  for (const TrajectoryScalar& scalar : layout.observables) {
    observables.push_back(std::string(observables_group) + "/" + scalar.name + "/value");
  }
}

void require_consistent(const TrajectoryLayout& layout) {
  const auto require = [](bool is_met, const std::string& message) {
    if (!is_met) throw ParameterError("trajectory: " + message);
  };
  const auto is_name = [](const std::string& name) {
    return !name.empty() && name != "." && name.find('/') == std::string::npos;
  };
  require(is_name(layout.particles),
          "the name of the particles is '" + layout.particles + "'; give one without '/'");
  require(layout.dimension == 2 || layout.dimension == 3,
          fmt::format("the dimension is {}; allowed are 2 and 3", layout.dimension));
  const auto dimension = static_cast<std::size_t>(layout.dimension);
  require(layout.box_edges.size() == dimension && layout.is_periodic.size() == dimension,
          fmt::format("the box has {} edges and {} kinds of boundary; give {} of each",
                      layout.box_edges.size(), layout.is_periodic.size(), dimension));
  for (const double edge : layout.box_edges) {
    require(std::isfinite(edge) && edge > 0,
            fmt::format("an edge of the box is {} m; it must be positive and finite", edge));
  }
  for (const std::int64_t nodes : layout.nodes_per_ring) {
    require(nodes >= 3, fmt::format("a ring has {} nodes; it needs at least 3", nodes));
  }
  require(layout.free_particles >= 0 && layout.particle_count() > 0,
          fmt::format("there are {} particles, {} of them free; at least one is needed",
                      layout.particle_count(), layout.free_particles));
  std::set<std::string> names{box_offset_name};
  for (const TrajectoryScalar& scalar : layout.observables) {
    require(is_name(scalar.name) && names.insert(scalar.name).second,
            "an observable is named '" + scalar.name +
                "'; give names without '/' that differ from each other and from box_offset");
  }
}

std::string difference(const TrajectoryLayout& stored, const TrajectoryLayout& wanted) {
  if (stored.particles != wanted.particles) return "name of the particles";
  if (stored.dimension != wanted.dimension) return "dimension";
  if (stored.nodes_per_ring != wanted.nodes_per_ring) return "number of nodes or cells";
  if (stored.free_particles != wanted.free_particles) return "number of free particles";
  if (stored.box_edges != wanted.box_edges) return "size of the box";
  if (stored.is_periodic != wanted.is_periodic) return "boundaries of the box";
  if (stored.has_velocities != wanted.has_velocities) return "whether velocities are stored";
  if (stored.single_precision != wanted.single_precision) return "precision";
  if (stored.observables != wanted.observables) return "list of observables";
  return {};
}

File make_file(const std::filesystem::path& path) {
  // A kill stops a write between two pages of memory, not within one: parts of the index must not
  // straddle them.
  constexpr hsize_t page_size = 4096;
  const Handle creation(check(H5Pcreate(H5P_FILE_CREATE), path, "make the file"), H5Pclose);
  check(H5Pset_file_space_strategy(creation.id(), H5F_FSPACE_STRATEGY_PAGE, false, 1), path,
        "make the file");
  check(H5Pset_file_space_page_size(creation.id(), page_size), path, "make the file");
  const Handle access = file_access(path);
  return {Handle(check(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), path,
                       "make the file"),
                 H5Fclose),
          path};
}

File open_to_append(const std::filesystem::path& path) {
  const Handle access = file_access(path);
  return {Handle(check(H5Fopen(path.c_str(), H5F_ACC_RDWR | H5F_ACC_SWMR_WRITE, access.id()), path,
                       "open for appending"),
                 H5Fclose),
          path};
}

File open_to_read(const std::filesystem::path& path) {
  const Handle access = file_access(path);
  hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id());
  // A writer that is writing, or was killed while it wrote, has left its mark in the file; then
  // HDF5 opens it in this mode alone.
  if (id < 0) id = H5Fopen(path.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, access.id());
  return {Handle(check(id, path, "open"), H5Fclose), path};
}

bool is_closed(const std::filesystem::path& path) {
  const Handle access = file_access(path);
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
  return file.id() >= 0;
}

}  // namespace hemoscale::micro::trajectory_format
