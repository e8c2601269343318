#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "coupling/scene/build_micro.hpp"
#include "micro/ensemble/frame.hpp"
#include "micro/particles/particle_set.hpp"
#include "micro/particles/periodic_box.hpp"
#include "micro/snapshot/trajectory_file.hpp"

namespace hemoscale::coupling {

/// An observer that writes the frames of an ensemble to an H5MD file. The file is opened at the
/// first frame: new if there is none, else continued (frames that a restart makes again replaced).
/// @param hdf5  held while HDF5 is in use: Debian's build of it must not be entered by two threads
micro::FrameObserver trajectory_writer(const std::filesystem::path& file,
                                       std::shared_ptr<std::mutex> hdf5);

/// Has each model of a coupled run write results/trajectory-SLOT.h5.
/// @param interval  between frames, in strain [-]
EnsembleHook trajectory_hook(const std::filesystem::path& results, double interval);

/// Writes the particles of a plasma to an H5MD file, as long as none enters or leaves: a file of
/// this layout holds one number of particles, and what comes after that is left out and said so.
class ParticleTrajectory {
 public:
  explicit ParticleTrajectory(std::filesystem::path file) : file_(std::move(file)) {}

  /// @throws EnvironmentError of the writer
  template <int dim>
  void append(const micro::ParticleSet<dim>& particles, const micro::PeriodicBox<dim>& box,
              std::int64_t step, double time);

  /// Why the file ends before the run, or nothing.
  const std::string& gap() const { return gap_; }

 private:
  std::filesystem::path file_;
  std::shared_ptr<micro::TrajectoryWriter> writer_;
  std::vector<std::int64_t> identities_;
  std::string gap_;
};

/// Writes the XDMF file beside every trajectory of a folder, for ParaView.
void finish_trajectories(const std::filesystem::path& results);

}  // namespace hemoscale::coupling
