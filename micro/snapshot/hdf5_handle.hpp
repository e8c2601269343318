#pragma once

#include <hdf5.h>

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

// For the sources of this folder alone; no header of the folder's public face includes it.
namespace hemoscale::micro::hdf5 {

/// While one exists, HDF5 prints nothing in this thread.
class Silence {
 public:
  Silence();
  ~Silence();
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Throws EnvironmentError "<path>: cannot <action>: <reason>". The reason is the system's, if
/// HDF5's error stack quotes one, else HDF5's own innermost one.
[[noreturn]] void fail(const std::filesystem::path& path, const std::string& action);

/// Throws as fail() does if `status` is negative, HDF5's sign of failure; else returns it.
template <typename Status>
Status check(Status status, const std::filesystem::path& path, const std::string& action) {
  if (status < 0) fail(path, action);
  return status;
}

/// Owns one HDF5 identifier.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Handle() = default;
  Handle(hid_t id, Close closing_call) : id_(id), close_(closing_call) {}
  Handle(Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);  // during unwinding; a success path calls close() and checks
  }

  hid_t id() const { return id_; }

  /// Closes now and returns HDF5's status: closing a file writes it, and may fail.
  [[nodiscard]] herr_t close() { return close_(std::exchange(id_, H5I_INVALID_HID)); }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// A file, and the few operations on it that this folder needs. `path` is used for messages alone.
class File {
 public:
  File(Handle handle, std::filesystem::path path)
      : handle_(std::move(handle)), path_(std::move(path)) {}

  hid_t id() const { return handle_.id(); }
  const std::filesystem::path& path() const { return path_; }

  Handle make_group(const std::string& name, bool keeps_order = false) const;
  Handle open_group(const std::string& name) const;
  bool has(const std::string& name) const;
  std::vector<std::string> names(const std::string& group, H5_index_t order = H5_INDEX_NAME) const;

  /// A data set of fixed extent, written at once. With `is_checked` HDF5 keeps a Fletcher checksum
  /// of its values and refuses to read them when damaged.
  void write(const std::string& name, hid_t file_type, hid_t memory_type,
             const std::vector<hsize_t>& extent, const void* values, bool is_checked = false) const;
  void write_text(const std::string& name, const std::string& text) const;
  void read(const std::string& name, hid_t memory_type, void* values) const;
  std::string read_text(const std::string& name) const;
  std::vector<hsize_t> extent(const std::string& name) const;

  /// Attributes of a group or data set.
  void set_attribute(const std::string& object, const std::string& name,
                     const std::string& text) const;
  void set_attribute(const std::string& object, const std::string& name,
                     const std::vector<std::string>& texts) const;
  void set_attribute(const std::string& object, const std::string& name,
                     const std::vector<int>& values) const;  // one value: scalar
  bool has_attribute(const std::string& object, const std::string& name) const;
  std::vector<std::string> text_attribute(const std::string& object, const std::string& name) const;
  std::vector<int> integer_attribute(const std::string& object, const std::string& name) const;

  /// @throws EnvironmentError if what is still to be written cannot be written
  void close();

 private:
  Handle handle_;
  std::filesystem::path path_;
};

}  // namespace hemoscale::micro::hdf5
