#include "micro/snapshot/checkpoint_image.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "micro/snapshot/hdf5_handle.hpp"

namespace hemoscale::micro {
namespace {

using hdf5::check;
using hdf5::File;
using hdf5::Handle;

Handle memory_access(const std::filesystem::path& path) {
  constexpr std::size_t growth = std::size_t{1} << 20;  // [byte] by which the memory grows
  Handle access(check(H5Pcreate(H5P_FILE_ACCESS), path, "use memory as a file"), H5Pclose);
  check(H5Pset_fapl_core(access.id(), growth, false), path, "use memory as a file");
  return access;
}

/// A name that HDF5 takes for one link: "/" and "." have a meaning in paths.
std::string to_link(const std::string& name) {
  if (name.empty()) return "%";
  constexpr const char* digits = "0123456789ABCDEF";
  std::string link;
  for (const char character : name) {
    if (character == '/' || character == '.' || character == '%' || character == '\0') {
      const auto code = static_cast<unsigned char>(character);
      link += {'%', digits[code >> 4], digits[code & 0xF]};
    } else {
      link += character;
    }
  }
  return link;
}

std::string from_link(const std::string& link) {
  if (link == "%") return {};
  const auto digit = [](char character) {
    return character <= '9' ? character - '0' : character - 'A' + 10;
  };
  std::string name;
  for (std::size_t k = 0; k < link.size(); ++k) {
    if (link[k] == '%' && k + 2 < link.size()) {
      name += static_cast<char>(16 * digit(link[k + 1]) + digit(link[k + 2]));
      k += 2;
    } else {
      name += link[k];
    }
  }
  return name;
}

std::string path_of(const std::string& group, const std::string& link) {
  std::string path = group;
  return path.append("/").append(link);
}

void write_texts(const File& file, const std::string& group,
                 const std::map<std::string, std::string>& texts) {
  file.make_group(group);
  for (const auto& [name, text] : texts) file.write_text(path_of(group, to_link(name)), text);
}

std::map<std::string, std::string> read_texts(const File& file, const std::string& group) {
  std::map<std::string, std::string> texts;
  for (const std::string& link : file.names(group)) {
    texts[from_link(link)] = file.read_text(path_of(group, link));
  }
  return texts;
}

template <typename Value>
void write_arrays(const File& file, const std::string& group, hid_t file_type, hid_t memory_type,
                  const std::map<std::string, std::vector<Value>>& arrays) {
  file.make_group(group);
  for (const auto& [name, values] : arrays) {
    file.write(path_of(group, to_link(name)), file_type, memory_type, {values.size()},
               values.data());
  }
}

template <typename Value>
std::map<std::string, std::vector<Value>> read_arrays(const File& file, const std::string& group,
                                                      hid_t memory_type) {
  std::map<std::string, std::vector<Value>> arrays;
  for (const std::string& link : file.names(group)) {
    const std::string name = path_of(group, link);
    const std::vector<hsize_t> extent = file.extent(name);
    if (extent.size() != 1) {
      throw EnvironmentError(file.path().string() + ": " + name +
                             " is not a list; the file is of another kind");
    }
    std::vector<Value> values(extent[0]);
    if (!values.empty()) file.read(name, memory_type, values.data());
    arrays[from_link(link)] = std::move(values);
  }
  return arrays;
}

}  // namespace

std::string to_image(const Checkpoint& checkpoint, const std::filesystem::path& path) {
  const hdf5::Silence silence;
  const Handle access = memory_access(path);
  File file(Handle(check(H5Fcreate("checkpoint", H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), path,
                         "make a checkpoint"),
                   H5Fclose),
            path);
  file.write("/number", H5T_STD_I64LE, H5T_NATIVE_INT64, {1}, &checkpoint.number);
  file.write("/time", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {1}, &checkpoint.time);
  file.set_attribute("/time", "unit", std::string("s"));
  write_texts(file, "/identity", checkpoint.identity);
  write_texts(file, "/texts", checkpoint.texts);
  file.make_group("/slots");
  for (const auto& [name, snapshot] : checkpoint.slots) {
    const std::string group = "/slots/" + to_link(name);
    file.make_group(group);
    write_arrays(file, group + "/reals", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, snapshot.reals);
    write_arrays(file, group + "/integers", H5T_STD_I64LE, H5T_NATIVE_INT64, snapshot.integers);
  }
  check(H5Fflush(file.id(), H5F_SCOPE_LOCAL), path, "make a checkpoint");
  const ssize_t size = H5Fget_file_image(file.id(), nullptr, 0);
  if (size < 0) hdf5::fail(path, "make a checkpoint");
  std::string image(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file.id(), image.data(), image.size()) != size) {
    hdf5::fail(path, "make a checkpoint");
  }
  file.close();
  return image;
}

Checkpoint from_image(const std::string& image, const std::filesystem::path& path) {
  const hdf5::Silence silence;
  const Handle access = memory_access(path);
  std::string copy = image;  // HDF5 asks for memory that it may write to, and copies it
  check(H5Pset_file_image(access.id(), copy.data(), copy.size()), path, "read the checkpoint");
  const File file(
      Handle(check(H5Fopen("checkpoint", H5F_ACC_RDONLY, access.id()), path, "read the checkpoint"),
             H5Fclose),
      path);
  Checkpoint checkpoint;
  file.read("/number", H5T_NATIVE_INT64, &checkpoint.number);
  file.read("/time", H5T_NATIVE_DOUBLE, &checkpoint.time);
  checkpoint.identity = read_texts(file, "/identity");
  checkpoint.texts = read_texts(file, "/texts");
  for (const std::string& link : file.names("/slots")) {
    const std::string group = "/slots/" + link;
    Snapshot& snapshot = checkpoint.slots[from_link(link)];
    snapshot.reals = read_arrays<double>(file, group + "/reals", H5T_NATIVE_DOUBLE);
    snapshot.integers = read_arrays<std::int64_t>(file, group + "/integers", H5T_NATIVE_INT64);
  }
  return checkpoint;
}

}  // namespace hemoscale::micro
