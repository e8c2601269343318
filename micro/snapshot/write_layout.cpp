#include "micro/snapshot/trajectory_format.hpp"

#include <algorithm>
#include <utility>

namespace hemoscale::micro::trajectory_format {
namespace {

using hdf5::check;
using hdf5::File;
using hdf5::Handle;

// Numbers in a chunk: scalars share one chunk among many frames; an array has chunks of its own in
// every frame, of at most half a megabyte.
constexpr hsize_t frames_per_chunk = 256;
constexpr hsize_t particles_per_chunk = 32768;

/// A data set that grows along its first axis, without frames yet.
void make_growing(const File& file, const std::string& name, hid_t type,
                  const std::vector<hsize_t>& frame_extent, const std::string& unit) {
  const std::string action = "make " + name;
  std::vector<hsize_t> extent{0};
  std::vector<hsize_t> limit{H5S_UNLIMITED};
  std::vector<hsize_t> chunk{frame_extent.empty() ? frames_per_chunk : 1};
  for (const hsize_t size : frame_extent) {
    extent.push_back(size);
    limit.push_back(size);
    chunk.push_back(std::min(size, particles_per_chunk));
  }
  const int rank = static_cast<int>(extent.size());
  const Handle space(
      check(H5Screate_simple(rank, extent.data(), limit.data()), file.path(), action), H5Sclose);
  const Handle properties(check(H5Pcreate(H5P_DATASET_CREATE), file.path(), action), H5Pclose);
  check(H5Pset_chunk(properties.id(), rank, chunk.data()), file.path(), action);
  // A chunk that later frames write to again must not carry a checksum: a kill between the two
  // would make earlier frames unreadable.
  if (!frame_extent.empty()) check(H5Pset_fletcher32(properties.id()), file.path(), action);
  const Handle set(check(H5Dcreate2(file.id(), name.c_str(), type, space.id(), H5P_DEFAULT,
                                    properties.id(), H5P_DEFAULT),
                         file.path(), action),
                   H5Dclose);
  if (!unit.empty()) file.set_attribute(name, "unit", unit);
}

void link_steps(const File& file, const Names& names, const std::string& element) {
  for (const auto& [target, name] : {std::pair{names.step, "/step"}, {names.time, "/time"}}) {
    check(H5Lcreate_hard(file.id(), target.c_str(), file.id(), (element + name).c_str(),
                         H5P_DEFAULT, H5P_DEFAULT),
          file.path(), "make " + element + name);
  }
}

std::string parent(const std::string& name) {
  return name.substr(0, name.rfind('/'));
}

std::vector<std::int64_t> ring_of_particle(const TrajectoryLayout& layout) {
  std::vector<std::int64_t> rings;
  for (std::size_t ring = 0; ring < layout.nodes_per_ring.size(); ++ring) {
    rings.insert(rings.end(), static_cast<std::size_t>(layout.nodes_per_ring[ring]),
                 static_cast<std::int64_t>(ring));
  }
  rings.insert(rings.end(), static_cast<std::size_t>(layout.free_particles), no_ring);
  return rings;
}

void write_bonds(const File& file, const TrajectoryLayout& layout, const Names& names) {
  std::vector<std::int64_t> bonds;
  std::int64_t first = 0;
  for (const std::int64_t nodes : layout.nodes_per_ring) {
    for (std::int64_t k = 0; k < nodes; ++k) {
      bonds.push_back(first + k);
      bonds.push_back(first + (k + 1) % nodes);
    }
    first += nodes;
  }
  file.make_group("/connectivity");
  const std::string name = "/connectivity/bonds";
  file.write(name, H5T_STD_I64LE, H5T_NATIVE_INT64, {bonds.size() / 2, 2}, bonds.data(), true);

  const std::string action = "refer to " + names.group;
  hobj_ref_t reference{};
  check(H5Rcreate(&reference, file.id(), names.group.c_str(), H5R_OBJECT, H5I_INVALID_HID),
        file.path(), action);
  const Handle space(check(H5Screate(H5S_SCALAR), file.path(), action), H5Sclose);
  const Handle attribute(
      check(H5Acreate_by_name(file.id(), name.c_str(), "particles_group", H5T_STD_REF_OBJ,
                              space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
            file.path(), action),
      H5Aclose);
  check(H5Awrite(attribute.id(), H5T_STD_REF_OBJ, &reference), file.path(), action);
}

}  // namespace

Topology topology_of(const TrajectoryLayout& layout) {
  Topology topology;
  topology.elements =
      static_cast<std::int64_t>(layout.nodes_per_ring.size()) + layout.free_particles;
  for (const std::int64_t nodes : layout.nodes_per_ring) {
    topology.nodes_per_element = std::max(topology.nodes_per_element, nodes + 1);
  }
  std::int64_t first = 0;
  const auto add_element = [&topology, &first](std::int64_t nodes) {
    for (std::int64_t k = 0; k < topology.nodes_per_element; ++k) {
      topology.values.push_back(k < nodes ? first + k : first);
    }
    first += nodes;
  };
  for (const std::int64_t nodes : layout.nodes_per_ring) add_element(nodes);
  for (std::int64_t k = 0; k < layout.free_particles; ++k) add_element(1);
  return topology;
}

void write_layout(const File& file, const TrajectoryLayout& layout) {
  const Names names(layout);
  file.make_group("/h5md");
  file.set_attribute("/h5md", "version", std::vector<int>{1, 1});
  file.make_group("/h5md/author");
  file.set_attribute("/h5md/author", "name", layout.author);
  file.make_group("/h5md/creator");
  file.set_attribute("/h5md/creator", "name", layout.creator);
  file.set_attribute("/h5md/creator", "version", layout.creator_version);
  file.make_group("/h5md/modules");
  file.make_group("/h5md/modules/units");
  file.set_attribute("/h5md/modules/units", "version", std::vector<int>{1, 0});
  file.set_attribute("/h5md/modules/units", "system", std::string("SI"));

  file.make_group("/particles");
  file.make_group(names.group);
  const std::string box = names.group + "/box";
  file.make_group(box);
  file.set_attribute(box, "dimension", std::vector<int>{layout.dimension});
  std::vector<std::string> boundaries;
  for (const bool periodic : layout.is_periodic)
    boundaries.emplace_back(periodic ? "periodic" : "none");
  file.set_attribute(box, "boundary", boundaries);
  file.write(box + "/edges", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {layout.box_edges.size()},
             layout.box_edges.data(), true);
  file.set_attribute(box + "/edges", "unit", std::string("m"));

  const auto particles = static_cast<hsize_t>(layout.particle_count());
  const auto dimension = static_cast<hsize_t>(layout.dimension);
  const hid_t real = layout.single_precision ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
  file.make_group(parent(names.positions));
  make_growing(file, names.positions, real, {particles, dimension}, "m");
  make_growing(file, names.step, H5T_STD_I64LE, {}, "");
  make_growing(file, names.time, H5T_IEEE_F64LE, {}, "s");
  if (layout.has_velocities) {
    file.make_group(parent(names.velocities));
    make_growing(file, names.velocities, real, {particles, dimension}, "m s-1");
    link_steps(file, names, parent(names.velocities));
  }
  const std::vector<std::int64_t> rings = ring_of_particle(layout);
  std::vector<std::int64_t> species(rings.size());
  std::transform(rings.begin(), rings.end(), species.begin(),
                 [](std::int64_t ring) { return ring == no_ring ? 1 : 0; });
  file.write(names.group + "/cell", H5T_STD_I64LE, H5T_NATIVE_INT64, {particles}, rings.data(),
             true);
  file.write(names.group + "/species", H5T_STD_I64LE, H5T_NATIVE_INT64, {particles}, species.data(),
             true);

  file.make_group(observables_group, true);
  file.make_group(parent(names.box_offset));
  make_growing(file, names.box_offset, H5T_IEEE_F64LE, {}, "m");
  link_steps(file, names, parent(names.box_offset));
  for (std::size_t k = 0; k < names.observables.size(); ++k) {
    file.make_group(parent(names.observables[k]));
    make_growing(file, names.observables[k], H5T_IEEE_F64LE, {}, layout.observables[k].unit);
    link_steps(file, names, parent(names.observables[k]));
  }
  file.make_group("/parameters");
  write_bonds(file, layout, names);
  const Topology topology = topology_of(layout);
  file.write(
      topology_name, H5T_STD_I64LE, H5T_NATIVE_INT64,
      {static_cast<hsize_t>(topology.elements), static_cast<hsize_t>(topology.nodes_per_element)},
      topology.values.data(), true);
}

}  // namespace hemoscale::micro::trajectory_format
