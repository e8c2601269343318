#include "micro/snapshot/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <system_error>
#include <utility>

#include "micro/snapshot/checkpoint_image.hpp"
#include "micro/snapshot/checksum.hpp"
#include "micro/snapshot/durable_file.hpp"

namespace hemoscale::micro {
namespace {

constexpr std::size_t user_block_size = 512;  // [byte] the least that HDF5 looks behind

/// What stands before the HDF5 part of the file. It is compared as a whole, so that damage of the
/// block itself is found too.
std::string user_block(std::string_view image) {
  std::string block = fmt::format("HemoScale checkpoint 1\nsize {} byte\nfnv1a64 {}\n",
                                  image.size(), to_hexadecimal(checksum(image)));
  block.resize(user_block_size, '\0');
  return block;
}

/// Number of a checkpoint from its file's name; none if it is not the name of one.
std::optional<std::int64_t> number_of(const std::filesystem::path& path) {
  constexpr std::string_view prefix = "checkpoint-";
  constexpr std::string_view suffix = ".h5";
  const std::string name = path.filename().string();
  if (name.size() <= prefix.size() + suffix.size() || !name.starts_with(prefix) ||
      !name.ends_with(suffix)) {
    return std::nullopt;
  }
  const char* const first = name.data() + prefix.size();
  const char* const last = name.data() + name.size() - suffix.size();
  std::int64_t number = 0;
  const auto result = std::from_chars(first, last, number);
  if (result.ec != std::errc{} || result.ptr != last || number < 0) return std::nullopt;
  return number;
}

std::string differences_as_text(const std::filesystem::path& path,
                                const std::vector<ForeignCheckpoint::Difference>& differences) {
  const auto quoted = [](const std::optional<std::string>& value) {
    return value ? "'" + *value + "'" : std::string("absent");
  };
  std::string text = path.string() +
                     ": this checkpoint is of another case; settings that define the state differ:";
  for (const auto& difference : differences) {
    text += fmt::format("\n  {}: {} in the checkpoint, {} in the case", difference.key,
                        quoted(difference.in_checkpoint), quoted(difference.in_case));
  }
  return text + "\nrestart with the settings of the checkpoint, or run anew without restart";
}

std::vector<ForeignCheckpoint::Difference> compare(
    const std::map<std::string, std::string>& in_checkpoint,
    const std::map<std::string, std::string>& in_case) {
  std::map<std::string, ForeignCheckpoint::Difference> by_key;
  for (const auto& [key, value] : in_checkpoint) {
    by_key[key].in_checkpoint = value;
  }
  for (const auto& [key, value] : in_case) {
    by_key[key].in_case = value;
  }
  std::vector<ForeignCheckpoint::Difference> differences;
  for (auto& [key, difference] : by_key) {
    if (difference.in_checkpoint == difference.in_case) continue;
    difference.key = key;
    differences.push_back(std::move(difference));
  }
  return differences;
}

/// After a checkpoint was written, the ones before it are kept up to the wanted number; those after
/// it belong to a future that this run has left, and would mislead the next restart.
void remove_superseded(const std::filesystem::path& folder, std::int64_t number, int keep) {
  int kept = 0;
  for (const std::filesystem::path& path : list_checkpoints(folder)) {
    if (number_of(path) <= number && kept < keep) {
      ++kept;
      continue;
    }
    std::error_code error;
    std::filesystem::remove(path, error);
    if (error) {
      throw EnvironmentError(path.string() +
                             ": cannot remove a superseded checkpoint: " + error.message());
    }
  }
}

}  // namespace

ForeignCheckpoint::ForeignCheckpoint(const std::filesystem::path& path,
                                     std::vector<Difference> found)
    : EnvironmentError(differences_as_text(path, found)), differences(std::move(found)) {}

std::filesystem::path write_checkpoint(const std::filesystem::path& folder,
                                       const Checkpoint& checkpoint, int keep) {
  if (checkpoint.number < 0 || keep < 1) {
    throw ParameterError(
        fmt::format("checkpoint {}, {} to be kept: give a number of at least 0 and "
                    "keep at least 1",
                    checkpoint.number, keep));
  }
  std::filesystem::path path = folder / fmt::format("checkpoint-{:06}.h5", checkpoint.number);
  const std::string image = to_image(checkpoint, path);
  write_durably(path, user_block(image) + image);
  remove_superseded(folder, checkpoint.number, keep);
  return path;
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  const std::string bytes = read_whole(path);
  const auto damaged = [&](const std::string& what) -> EnvironmentError {
    return EnvironmentError(path.string() + ": the checkpoint is damaged: " + what);
  };
  if (bytes.size() < user_block_size) {
    throw damaged(fmt::format("it has {} byte, fewer than its header", bytes.size()));
  }
  const std::string image = bytes.substr(user_block_size);
  if (std::string_view(bytes).substr(0, user_block_size) != user_block(image)) {
    throw damaged("size or checksum of its content is not that of its header");
  }
  return from_image(image, path);
}

std::vector<std::filesystem::path> list_checkpoints(const std::filesystem::path& folder) {
  std::vector<std::pair<std::int64_t, std::filesystem::path>> numbered;
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) return {};
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (const auto number = number_of(entry.path())) numbered.emplace_back(*number, entry.path());
  }
  if (error)
    throw EnvironmentError(folder.string() + ": cannot list the folder: " + error.message());
  std::sort(numbered.rbegin(), numbered.rend());
  std::vector<std::filesystem::path> paths;
  paths.reserve(numbered.size());
  for (auto& [number, path] : numbered) paths.push_back(std::move(path));
  return paths;
}

std::optional<std::filesystem::path> newest_checkpoint(const std::filesystem::path& folder) {
  const std::vector<std::filesystem::path> paths = list_checkpoints(folder);
  if (paths.empty()) return std::nullopt;
  return paths.front();
}

RestoredCheckpoint restore_checkpoint(const std::filesystem::path& folder,
                                      const std::map<std::string, std::string>& identity) {
  std::vector<std::string> faults;
  for (const std::filesystem::path& path : list_checkpoints(folder)) {
    Checkpoint checkpoint;
    try {
      checkpoint = read_checkpoint(path);
    } catch (const EnvironmentError& error) {
      faults.emplace_back(error.what());
      continue;
    }
    if (auto differences = compare(checkpoint.identity, identity); !differences.empty()) {
      throw ForeignCheckpoint(path, std::move(differences));
    }
    for (std::string& fault : faults) fault += "; continuing from the older " + path.string();
    return {std::move(checkpoint), path, std::move(faults)};
  }
  if (faults.empty()) {
    throw EnvironmentError(folder.string() +
                           ": there is no checkpoint to restart from; run without restart");
  }
  std::string text = folder.string() + ": no checkpoint is whole; run without restart";
  for (const std::string& fault : faults) text += "\n  " + fault;
  throw EnvironmentError(text);
}

}  // namespace hemoscale::micro
