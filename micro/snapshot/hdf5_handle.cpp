#include "micro/snapshot/hdf5_handle.hpp"

#include <algorithm>
#include <cstddef>

#include "micro/error.hpp"

namespace hemoscale::micro::hdf5 {
namespace {

/// What HDF5's error stack says, from the innermost entry outwards.
struct Reason {
  std::string system;     // text of errno, if quoted
  std::string innermost;  // HDF5's own words
};

herr_t collect(unsigned, const H5E_error2_t* entry, void* data) {
  auto& reason = *static_cast<Reason*>(data);
  const std::string text = entry->desc != nullptr ? entry->desc : "";
  if (reason.innermost.empty()) reason.innermost = text;
  constexpr std::string_view marker = "error message = '";
  if (const auto start = text.find(marker); reason.system.empty() && start != std::string::npos) {
    const auto first = start + marker.size();
    reason.system = text.substr(first, text.find('\'', first) - first);
  }
  return 0;
}

Handle fixed_length_type(std::size_t length, const std::filesystem::path& path) {
  Handle type(check(H5Tcopy(H5T_C_S1), path, "make a text type"), H5Tclose);
  // HDF5 knows no text of length zero.
  check(H5Tset_size(type.id(), std::max<std::size_t>(length, 1)), path, "size a text type");
  check(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), path, "pad a text type");
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), path, "make a text type");
  return type;
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* data) {
  static_cast<std::vector<std::string>*>(data)->emplace_back(name);
  return 0;
}

std::string without_padding(const char* text, std::size_t length) {
  return {text, std::find(text, text + length, '\0')};
}

Handle open_attribute(const File& file, const std::string& object, const std::string& name) {
  return {check(H5Aopen_by_name(file.id(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                file.path(), "read the attribute " + name + " of " + object),
          H5Aclose};
}

std::size_t value_count(const Handle& attribute, const std::filesystem::path& path) {
  const Handle space(check(H5Aget_space(attribute.id()), path, "read an attribute"), H5Sclose);
  return static_cast<std::size_t>(
      check(H5Sget_simple_extent_npoints(space.id()), path, "read an attribute"));
}

void write_attribute(const File& file, const std::string& object, const std::string& name,
                     const Handle& space, hid_t type, const void* values) {
  const std::string action = "write the attribute " + name + " of " + object;
  Handle attribute(check(H5Acreate_by_name(file.id(), object.c_str(), name.c_str(), type,
                                           space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                         file.path(), action),
                   H5Aclose);
  check(H5Awrite(attribute.id(), type, values), file.path(), action);
}

}  // namespace

Silence::Silence() {
  // Every file is closed here, with a check. After a failure HDF5 would try once more at the end of
  // the process, in vain and aloud.
  H5dont_atexit();
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Silence::~Silence() {
  H5Eset_auto2(H5E_DEFAULT, function_, data_);
}

void fail(const std::filesystem::path& path, const std::string& action) {
  Reason reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, collect, &reason);
  H5Eclear2(H5E_DEFAULT);
  std::string text = reason.system.empty() ? reason.innermost : reason.system;
  if (text.empty()) text = "HDF5 gives no reason";
  throw EnvironmentError(path.string() + ": cannot " + action + ": " + text);
}

Handle File::make_group(const std::string& name, bool keeps_order) const {
  const Handle properties(check(H5Pcreate(H5P_GROUP_CREATE), path_, "make a group"), H5Pclose);
  if (keeps_order) {
    check(
        H5Pset_link_creation_order(properties.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED),
        path_, "make a group");
  }
  return {check(H5Gcreate2(id(), name.c_str(), H5P_DEFAULT, properties.id(), H5P_DEFAULT), path_,
                "make the group " + name),
          H5Gclose};
}

Handle File::open_group(const std::string& name) const {
  return {check(H5Gopen2(id(), name.c_str(), H5P_DEFAULT), path_, "find the group " + name),
          H5Gclose};
}

bool File::has(const std::string& name) const {
  return check(H5Lexists(id(), name.c_str(), H5P_DEFAULT), path_, "look for " + name) > 0;
}

std::vector<std::string> File::names(const std::string& group, H5_index_t order) const {
  const Handle opened = open_group(group);
  std::vector<std::string> names;
  hsize_t start = 0;
  check(H5Literate(opened.id(), order, H5_ITER_INC, &start, collect_name, &names), path_,
        "list the group " + group);
  return names;
}

void File::write(const std::string& name, hid_t file_type, hid_t memory_type,
                 const std::vector<hsize_t>& extent, const void* values, bool is_checked) const {
  const std::string action = "write " + name;
  const bool is_empty = std::find(extent.begin(), extent.end(), hsize_t{0}) != extent.end();
  const Handle space(
      check(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), path_,
            action),
      H5Sclose);
  const Handle properties(check(H5Pcreate(H5P_DATASET_CREATE), path_, action), H5Pclose);
  // Same content, same file: no clock in it.
  check(H5Pset_obj_track_times(properties.id(), false), path_, action);
  if (is_checked && !is_empty) {
    check(H5Pset_chunk(properties.id(), static_cast<int>(extent.size()), extent.data()), path_,
          action);
    check(H5Pset_fletcher32(properties.id()), path_, action);
  }
  const Handle set(check(H5Dcreate2(id(), name.c_str(), file_type, space.id(), H5P_DEFAULT,
                                    properties.id(), H5P_DEFAULT),
                         path_, action),
                   H5Dclose);
  if (is_empty) return;
  check(H5Dwrite(set.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), path_, action);
}

void File::write_text(const std::string& name, const std::string& text) const {
  // As bytes: a text may be empty or hold any character, which HDF5's text types do not allow.
  write(name, H5T_STD_U8LE, H5T_NATIVE_UCHAR, {text.size()}, text.data());
}

void File::read(const std::string& name, hid_t memory_type, void* values) const {
  const std::string action = "read " + name;
  const Handle set(check(H5Dopen2(id(), name.c_str(), H5P_DEFAULT), path_, action), H5Dclose);
  check(H5Dread(set.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), path_, action);
}

std::string File::read_text(const std::string& name) const {
  const std::vector<hsize_t> size = extent(name);
  if (size.size() != 1) {
    throw EnvironmentError(path_.string() + ": " + name +
                           " is not a text; the file is of another kind");
  }
  std::string text(size[0], '\0');
  if (!text.empty()) read(name, H5T_NATIVE_UCHAR, text.data());
  return text;
}

std::vector<hsize_t> File::extent(const std::string& name) const {
  const std::string action = "read the extent of " + name;
  const Handle set(check(H5Dopen2(id(), name.c_str(), H5P_DEFAULT), path_, action), H5Dclose);
  const Handle space(check(H5Dget_space(set.id()), path_, action), H5Sclose);
  const int rank = check(H5Sget_simple_extent_ndims(space.id()), path_, action);
  std::vector<hsize_t> extent(static_cast<std::size_t>(rank));
  check(H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr), path_, action);
  return extent;
}

void File::set_attribute(const std::string& object, const std::string& name,
                         const std::string& text) const {
  const Handle space(check(H5Screate(H5S_SCALAR), path_, "write an attribute"), H5Sclose);
  const Handle type = fixed_length_type(text.size(), path_);
  write_attribute(*this, object, name, space, type.id(), text.c_str());
}

void File::set_attribute(const std::string& object, const std::string& name,
                         const std::vector<std::string>& texts) const {
  std::size_t length = 1;
  for (const std::string& text : texts) length = std::max(length, text.size());
  std::vector<char> packed(length * texts.size(), '\0');
  for (std::size_t k = 0; k < texts.size(); ++k) {
    std::copy(texts[k].begin(), texts[k].end(),
              packed.begin() + static_cast<std::ptrdiff_t>(k * length));
  }
  const hsize_t extent = texts.size();
  const Handle space(check(H5Screate_simple(1, &extent, nullptr), path_, "write an attribute"),
                     H5Sclose);
  const Handle type = fixed_length_type(length, path_);
  write_attribute(*this, object, name, space, type.id(), packed.data());
}

void File::set_attribute(const std::string& object, const std::string& name,
                         const std::vector<int>& values) const {
  const hsize_t extent = values.size();
  const Handle space(
      check(extent == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &extent, nullptr), path_,
            "write an attribute"),
      H5Sclose);
  write_attribute(*this, object, name, space, H5T_NATIVE_INT, values.data());
}

bool File::has_attribute(const std::string& object, const std::string& name) const {
  return check(H5Aexists_by_name(id(), object.c_str(), name.c_str(), H5P_DEFAULT), path_,
               "look for the attribute " + name + " of " + object) > 0;
}

std::vector<std::string> File::text_attribute(const std::string& object,
                                              const std::string& name) const {
  const std::string action = "read the attribute " + name + " of " + object;
  const Handle attribute = open_attribute(*this, object, name);
  const Handle stored(check(H5Aget_type(attribute.id()), path_, action), H5Tclose);
  const std::size_t length = H5Tget_size(stored.id());
  if (H5Tget_class(stored.id()) != H5T_STRING || H5Tis_variable_str(stored.id()) > 0) {
    throw EnvironmentError(path_.string() + ": the attribute " + name + " of " + object +
                           " is not a text of fixed length; the file is of another kind");
  }
  const std::size_t count = value_count(attribute, path_);
  std::vector<char> packed(length * count);
  check(H5Aread(attribute.id(), stored.id(), packed.data()), path_, action);
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < count; ++k) {
    texts.push_back(without_padding(packed.data() + k * length, length));
  }
  return texts;
}

std::vector<int> File::integer_attribute(const std::string& object, const std::string& name) const {
  const Handle attribute = open_attribute(*this, object, name);
  std::vector<int> values(value_count(attribute, path_));
  check(H5Aread(attribute.id(), H5T_NATIVE_INT, values.data()), path_,
        "read the attribute " + name + " of " + object);
  return values;
}

void File::close() {
  check(handle_.close(), path_, "finish writing");
}

}  // namespace hemoscale::micro::hdf5
