#include "micro/snapshot/durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <system_error>
#include <utility>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* action, int error) {
  throw EnvironmentError(path.string() + ": cannot " + action + ": " +
                         std::generic_category().message(error));
}

/// Owns one file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  int value() const { return value_; }
  int close() { return ::close(std::exchange(value_, -1)); }

 private:
  int value_;
};

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

void force_to_disk(const std::filesystem::path& path, int flags) {
  const Descriptor descriptor(::open(path.c_str(), flags | O_CLOEXEC));
  if (descriptor.value() < 0) fail(path, "open", errno);
  // Some file systems cannot do it for a folder (EINVAL), which is no fault of the file.
  if (::fsync(descriptor.value()) != 0 && errno != EINVAL) fail(path, "force to the disk", errno);
}

}  // namespace

PartFile::PartFile(std::filesystem::path target) : target_(std::move(target)) {
  std::error_code error;
  std::filesystem::create_directories(folder_of(target_), error);
  if (error) fail(folder_of(target_), "make the folder", error.value());
}

PartFile::~PartFile() {
  std::error_code ignored;
  if (!is_in_place_) std::filesystem::remove(path(), ignored);
}

std::filesystem::path PartFile::path() const {
  return target_.string() + ".part";
}

void PartFile::move_into_place() {
  force_to_disk(path(), O_RDONLY);
  if (::rename(path().c_str(), target_.c_str()) != 0) fail(target_, "rename into place", errno);
  is_in_place_ = true;
  force_to_disk(folder_of(target_), O_RDONLY | O_DIRECTORY);  // else the new name may be lost
}

void write_durably(const std::filesystem::path& path, std::string_view bytes) {
  PartFile part(path);
  Descriptor file(::open(part.path().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.value() < 0) fail(part.path(), "open for writing", errno);
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.value(), bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      fail(path, "write", errno);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (file.close() != 0) fail(path, "finish writing", errno);
  part.move_into_place();
}

std::string read_whole(const std::filesystem::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.value() < 0) fail(path, "open", errno);
  std::string bytes;
  std::string block(std::size_t{1} << 16, '\0');
  while (true) {
    const ssize_t count = ::read(file.value(), block.data(), block.size());
    if (count == 0) return bytes;
    if (count < 0) {
      if (errno == EINTR) continue;
      fail(path, "read", errno);
    }
    bytes.append(block, 0, static_cast<std::size_t>(count));
  }
}

}  // namespace hemoscale::micro
