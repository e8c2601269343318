#pragma once

#include <filesystem>
#include <string>

#include "micro/snapshot/checkpoint.hpp"

// For the sources of this folder alone.
namespace hemoscale::micro {

/// A checkpoint as the bytes of an HDF5 file, made in memory: what reaches the disk is then written
/// by plain calls whose errors are exact.
/// @param path  for messages
std::string to_image(const Checkpoint& checkpoint, const std::filesystem::path& path);

/// @throws EnvironmentError if the file is not of this kind
Checkpoint from_image(const std::string& image, const std::filesystem::path& path);

}  // namespace hemoscale::micro
