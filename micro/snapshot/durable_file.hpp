#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace hemoscale::micro {

/// Writes `path` so that at every moment it is either the old file or the whole new one: writes
/// `path` + ".part", forces it to the disk (fsync), renames it, and forces the folder to the disk.
/// Missing folders are made. On failure the old file is intact and the part is removed.
/// @throws EnvironmentError with path and the system's reason
void write_durably(const std::filesystem::path& path, std::string_view bytes);

/// A file that is written aside by someone else: lies at `target` + ".part" until it is moved into
/// place, and is removed if that does not happen. Makes missing folders.
class PartFile {
 public:
  /// @throws EnvironmentError if the folder cannot be made
  explicit PartFile(std::filesystem::path target);
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  ~PartFile();

  std::filesystem::path path() const;

  /// Forces the file to the disk (fsync), renames it, and forces the folder to the disk.
  /// @throws EnvironmentError with path and the system's reason
  void move_into_place();

 private:
  std::filesystem::path target_;
  bool is_in_place_ = false;
};

/// The whole content of a file.
/// @throws EnvironmentError with path and the system's reason
std::string read_whole(const std::filesystem::path& path);

}  // namespace hemoscale::micro
