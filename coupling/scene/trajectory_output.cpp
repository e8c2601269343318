#include "coupling/scene/trajectory_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
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
