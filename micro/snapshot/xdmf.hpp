#pragma once

#include <filesystem>

namespace hemoscale::micro {

/// Writes beside a trajectory the XDMF 3 file through which ParaView opens it: one grid per frame,
/// every ring a closed polyline, velocities and the number of the ring as attributes, scalars of
/// the frame as grid attributes. The file names the trajectory relative to itself and is written
/// aside, then renamed. Frames that are appended later are not in it: call again.
///
/// @param trajectory  a file of TrajectoryWriter
/// @return            path of the XDMF file: that of the trajectory with the extension ".xdmf"
/// @throws EnvironmentError
std::filesystem::path write_xdmf(const std::filesystem::path& trajectory);

}  // namespace hemoscale::micro
