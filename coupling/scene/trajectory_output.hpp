#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>

#include "coupling/scene/build_micro.hpp"
#include "micro/ensemble/frame.hpp"

namespace hemoscale::coupling {

/// An observer that writes the frames of an ensemble to an H5MD file. The file is opened at the
/// first frame: new if there is none, else continued (frames that a restart makes again replaced).
/// @param hdf5  held while HDF5 is in use: Debian's build of it must not be entered by two threads
micro::FrameObserver trajectory_writer(const std::filesystem::path& file,
                                       std::shared_ptr<std::mutex> hdf5);

/// Has each model of a coupled run write results/trajectory-SLOT.h5.
/// @param interval  between frames, in strain [-]
EnsembleHook trajectory_hook(const std::filesystem::path& results, double interval);

/// Writes the XDMF file beside every trajectory of a folder, for ParaView.
void finish_trajectories(const std::filesystem::path& results);

}  // namespace hemoscale::coupling
