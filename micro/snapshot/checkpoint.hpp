#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "micro/error.hpp"
#include "micro/model.hpp"

namespace hemoscale::micro {

/// Everything that is needed to continue a run with the same bits.
struct Checkpoint {
  std::int64_t number = 0;                      // [-] e.g. the pass; part of the file's name
  double time = 0;                              // [s] of the run
  std::map<std::string, std::string> identity;  // the settings that define the state, as text
  std::map<std::string, std::string> texts;     // version and whatever else is not state
  std::map<std::string, Snapshot> slots;        // e.g. one per micro model and one of the loop
};

/// The checkpoint belongs to another case.
struct ForeignCheckpoint : EnvironmentError {
  struct Difference {
    std::string key;
    std::optional<std::string> in_checkpoint;  // absent: the checkpoint does not know the key
    std::optional<std::string> in_case;
  };
  ForeignCheckpoint(const std::filesystem::path& path, std::vector<Difference> found);
  std::vector<Difference> differences;
};

/// Writes `folder/checkpoint-NNNNNN.h5` (NNNNNN = number): aside, to the disk (fsync), then
/// renamed; afterwards deletes all but the `keep` newest checkpoints. The folder is made if it is
/// missing.
///
/// The file is HDF5 behind a user block of 512 bytes, which holds size and checksum of the rest:
/// any damage is found before HDF5 sees the file.
///
/// @return path of the file
/// @throws EnvironmentError with path and the system's reason; older checkpoints are then intact
std::filesystem::path write_checkpoint(const std::filesystem::path& folder,
                                       const Checkpoint& checkpoint, int keep = 2);

/// @throws EnvironmentError if the file is missing, damaged in any byte, or of another kind
Checkpoint read_checkpoint(const std::filesystem::path& path);

/// Checkpoints of a folder, the newest first, without looking inside; none if there is no folder.
std::vector<std::filesystem::path> list_checkpoints(const std::filesystem::path& folder);
std::optional<std::filesystem::path> newest_checkpoint(const std::filesystem::path& folder);

/// A checkpoint with the story of how it was found.
struct RestoredCheckpoint {
  Checkpoint checkpoint;
  std::filesystem::path path;
  std::vector<std::string> warnings;  // one per newer file that is damaged; to be shown to the user
};

/// The newest checkpoint that is whole. Damaged newer ones are named in the warnings.
/// @param identity  the settings of the present case that define the state
/// @throws EnvironmentError if there is none; ForeignCheckpoint if the newest whole one is of
///         another case (an older one is then not tried)
RestoredCheckpoint restore_checkpoint(const std::filesystem::path& folder,
                                      const std::map<std::string, std::string>& identity);

}  // namespace hemoscale::micro
