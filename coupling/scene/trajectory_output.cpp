#include "coupling/scene/trajectory_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "coupling/report/summary.hpp"
#include "micro/snapshot/trajectory_file.hpp"
#include "micro/snapshot/xdmf.hpp"

namespace hemoscale::coupling {

namespace {

micro::TrajectoryLayout layout_of(const micro::EnsembleFrame& frame) {
  micro::TrajectoryLayout layout;
  layout.creator_version = program_version();
  const std::int32_t cells = frame.cell_ids.empty() ? 0 : frame.cell_ids.back() + 1;
  layout.nodes_per_ring.assign(static_cast<std::size_t>(cells), 0);
  for (const std::int32_t cell : frame.cell_ids)
    ++layout.nodes_per_ring[static_cast<std::size_t>(cell)];
  layout.box_edges = {frame.length, frame.height};
  layout.is_periodic = {true, !frame.walls};
  layout.single_precision = true;
  return layout;
}

/// Where each of `wanted` stands in `identities`, which hold the same numbers.
std::vector<std::size_t> places_of(const std::vector<std::int64_t>& identities,
                                   const std::vector<std::int64_t>& wanted) {
  std::unordered_map<std::int64_t, std::size_t> place;
  for (std::size_t i = 0; i < identities.size(); ++i) place[identities[i]] = i;
  std::vector<std::size_t> places;
  places.reserve(wanted.size());
  for (const std::int64_t identity : wanted) places.push_back(place.at(identity));
  return places;
}

}  // namespace

micro::FrameObserver trajectory_writer(const std::filesystem::path& file,
                                       std::shared_ptr<std::mutex> hdf5) {
  // Shared, because an observer is copied.
  const auto writer = std::make_shared<std::optional<micro::TrajectoryWriter>>();
  return [file, writer, hdf5 = std::move(hdf5)](const micro::EnsembleFrame& frame) {
    const std::lock_guard<std::mutex> lock(*hdf5);
    if (!*writer) {
      *writer = micro::TrajectoryWriter::resume(file, layout_of(frame), frame.step - 1);
    }
    micro::TrajectoryFrame stored;
    stored.step = frame.step;
    stored.time = frame.time;
    stored.positions = frame.positions;
    stored.box_offset = frame.image_offset;
    (*writer)->append(stored);
  };
}

EnsembleHook trajectory_hook(const std::filesystem::path& results, double interval) {
  const auto hdf5 = std::make_shared<std::mutex>();
  return [results, interval, hdf5](int slot, micro::EnsembleModel& model) {
    model.observe(micro::FrameClock::strain, interval,
                  trajectory_writer(results / fmt::format("trajectory-{:03d}.h5", slot), hdf5));
  };
}

template <int dim>
void ParticleTrajectory::append(const micro::ParticleSet<dim>& particles,
                                const micro::PeriodicBox<dim>& box, std::int64_t step,
                                double time) {
  if (!gap_.empty()) return;
  if (!writer_) {
    micro::TrajectoryLayout layout;
    layout.particles = "particles";
    layout.creator_version = program_version();
    layout.dimension = dim;
    layout.free_particles = static_cast<std::int64_t>(particles.size());
    for (int axis = 0; axis < dim; ++axis) {
      layout.box_edges.push_back(box.extent()[axis]);
      layout.is_periodic.push_back(box.periodic[static_cast<std::size_t>(axis)]);
    }
    layout.has_velocities = true;
    layout.single_precision = true;
    identities_ = particles.identities;
    writer_ = std::make_shared<micro::TrajectoryWriter>(
        micro::TrajectoryWriter::resume(file_, layout, step - 1));
  }
  if (particles.identities.size() != identities_.size()) {
    gap_ = fmt::format(
        "particles enter and leave: trajectory.h5 ends before {:.6g} s; particles.csv holds the "
        "last "
        "ones",
        time);
    return;
  }
  // Frames keep the order of the first; particles may have been reordered in memory.
  std::vector<double> positions;
  std::vector<double> velocities;
  for (const std::size_t i : places_of(particles.identities, identities_)) {
    positions.insert(positions.end(), particles.positions[i].data(),
                     particles.positions[i].data() + dim);
    velocities.insert(velocities.end(), particles.velocities[i].data(),
                      particles.velocities[i].data() + dim);
  }
  micro::TrajectoryFrame frame;
  frame.step = step;
  frame.time = time;
  frame.positions = positions;
  frame.velocities = velocities;
  frame.box_offset = box.slide;
  writer_->append(frame);
}

template void ParticleTrajectory::append<2>(const micro::ParticleSet<2>&,
                                            const micro::PeriodicBox<2>&, std::int64_t, double);
template void ParticleTrajectory::append<3>(const micro::ParticleSet<3>&,
                                            const micro::PeriodicBox<3>&, std::int64_t, double);

void finish_trajectories(const std::filesystem::path& results) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(results)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("trajectory", 0) == 0 && entry.path().extension() == ".h5") {
      files.push_back(entry.path());
    }
  }
  for (const std::filesystem::path& file : files) micro::write_xdmf(file);
}

}  // namespace hemoscale::coupling
