#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "coupling/config/read_case.hpp"
#include "coupling/error.hpp"

namespace hemoscale::coupling {

/// A case file with a given text, that goes when this object does. Tests run side by side, hence
/// the process id in its name.
class CaseFile {
 public:
  explicit CaseFile(const std::string& text) {
    std::string folder = testing::TempDir() + "hemoscale-config-XXXXXX";
    if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = folder;
    std::ofstream(path(), std::ios::binary) << text;
  }
  ~CaseFile() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  CaseFile(const CaseFile&) = delete;
  CaseFile& operator=(const CaseFile&) = delete;

  std::filesystem::path path() const { return folder_ / "case.toml"; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

inline ParameterTree tree_of(const std::string& text) {
  return read_toml(CaseFile(text).path());
}

inline Settings settings_of(const std::string& text, const std::string& variant = "") {
  return interpret(tree_of(text), variant);
}

/// The faults of a case; empty if it has none.
inline std::vector<Fault> faults_of(const std::string& text, const std::string& variant = "") {
  try {
    settings_of(text, variant);
  } catch (const CaseError& error) {
    return error.faults();
  }
  return {};
}

/// "line:column key" of every fault: where, without the words.
inline std::vector<std::string> places_of(const std::vector<Fault>& faults) {
  std::vector<std::string> places;
  for (const Fault& fault : faults) {
    places.push_back(std::to_string(fault.line) + ":" + std::to_string(fault.column) + " " +
                     fault.key);
  }
  return places;
}

/// The smallest valid case, five lines; more keys may follow.
inline const std::string smallest_case =
    "case.name = \"a\"\n"
    "fluid.hematocrit = 0.4\n"
    "macro.channel.height = \"80 um\"\n"
    "macro.channel.mean_velocity = \"10 mm/s\"\n"
    "\n";

}  // namespace hemoscale::coupling
