#include "micro/snapshot/trajectory_format.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "micro/error.hpp"

namespace hemoscale::micro::trajectory_format {
namespace {

using hdf5::check;
using hdf5::File;
using hdf5::Handle;

[[noreturn]] void damaged(const File& file, const std::string& what) {
  throw EnvironmentError(
      file.path().string() + ": " + what +
      "; the file is damaged or of another kind: move it away to start a new one");
}

std::string one_text(const File& file, const std::string& object, const std::string& name) {
  const std::vector<std::string> texts = file.text_attribute(object, name);
  if (texts.size() != 1)
    damaged(file, "the attribute " + name + " of " + object + " is not one text");
  return texts[0];
}

void read_rings(const File& file, const std::string& group, TrajectoryLayout& layout) {
  const std::vector<hsize_t> extent = file.extent(group + "/cell");
  if (extent.size() != 1) damaged(file, group + "/cell is not a list");
  std::vector<std::int64_t> rings(extent[0]);
  file.read(group + "/cell", H5T_NATIVE_INT64, rings.data());
  for (const std::int64_t ring : rings) {
    const auto known = static_cast<std::int64_t>(layout.nodes_per_ring.size());
    if (ring == no_ring) {
      ++layout.free_particles;
    } else if (layout.free_particles == 0 && ring == known) {
      layout.nodes_per_ring.push_back(1);
    } else if (layout.free_particles == 0 && ring == known - 1) {
      ++layout.nodes_per_ring.back();
    } else {
      damaged(file, group + "/cell does not list the nodes ring after ring");
    }
  }
}

}  // namespace

TrajectoryLayout read_layout(const File& file) {
  if (!file.has("/h5md") || !file.has("/particles")) damaged(file, "it is not an H5MD file");
  const std::vector<int> version = file.integer_attribute("/h5md", "version");
  if (version.size() != 2 || version[0] != 1) damaged(file, "its version of H5MD is not 1.x");
  TrajectoryLayout layout;
  layout.author = one_text(file, "/h5md/author", "name");
  layout.creator = one_text(file, "/h5md/creator", "name");
  layout.creator_version = one_text(file, "/h5md/creator", "version");
  const std::vector<std::string> groups = file.names("/particles");
  if (groups.size() != 1)
    damaged(file, fmt::format("it has {} groups of particles", groups.size()));
  layout.particles = groups[0];

  const std::string group = "/particles/" + layout.particles;
  const std::vector<int> dimension = file.integer_attribute(group + "/box", "dimension");
  if (dimension.size() != 1) damaged(file, "the dimension of its box is not one number");
  layout.dimension = dimension[0];
  for (const std::string& boundary : file.text_attribute(group + "/box", "boundary")) {
    layout.is_periodic.push_back(boundary == "periodic");
  }
  const std::vector<hsize_t> edges = file.extent(group + "/box/edges");
  if (edges.size() != 1 || edges[0] > 3) damaged(file, "the edges of its box are not a short list");
  layout.box_edges.resize(edges[0]);
  file.read(group + "/box/edges", H5T_NATIVE_DOUBLE, layout.box_edges.data());
  read_rings(file, group, layout);
  layout.has_velocities = file.has(group + "/velocity");
  for (const std::string& name : file.names(observables_group, H5_INDEX_CRT_ORDER)) {
    if (name == box_offset_name) continue;
    const std::string value = std::string(observables_group) + "/" + name + "/value";
    const bool has_unit = file.has_attribute(value, "unit");
    layout.observables.push_back({name, has_unit ? one_text(file, value, "unit") : ""});
  }
  const Names names(layout);
  const Handle set(check(H5Dopen2(file.id(), names.positions.c_str(), H5P_DEFAULT), file.path(),
                         "read " + names.positions),
                   H5Dclose);
  const Handle type(check(H5Dget_type(set.id()), file.path(), "read " + names.positions), H5Tclose);
  layout.single_precision = H5Tget_size(type.id()) == sizeof(float);
  try {
    require_consistent(layout);
  } catch (const ParameterError& error) {
    damaged(file, error.what());
  }
  const auto particles = static_cast<hsize_t>(layout.particle_count());
  for (const std::string& name : {names.positions, names.velocities}) {
    if (name == names.velocities && !layout.has_velocities) continue;
    const std::vector<hsize_t> extent = file.extent(name);
    if (extent.size() != 3 || extent[1] != particles ||
        extent[2] != static_cast<hsize_t>(layout.dimension)) {
      damaged(file, name + " is not of the number of particles and the dimension");
    }
  }
  return layout;
}

FrameCount count_frames(const File& file, const TrajectoryLayout& layout) {
  const Names names(layout);
  std::vector<std::string> growing{names.positions, names.box_offset, names.time, names.step};
  if (layout.has_velocities) growing.push_back(names.velocities);
  growing.insert(growing.end(), names.observables.begin(), names.observables.end());
  FrameCount count;
  for (bool is_first = true; const std::string& name : growing) {
    const std::vector<hsize_t> extent = file.extent(name);
    if (extent.empty()) damaged(file, name + " does not grow");
    count.is_even = count.is_even && (is_first || extent[0] == count.complete);
    count.complete = is_first ? extent[0] : std::min(count.complete, extent[0]);
    is_first = false;
  }
  return count;
}

}  // namespace hemoscale::micro::trajectory_format
