#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hemoscale::test {

/// Result of a program run by a test.
struct Outcome {
  int status = -1;     // exit status; 128 + signal
  std::string output;  // stdout and stderr
};

/// An OpenFOAM case in a folder of its own, removed at the end of the test unless it failed.
class CaseFolder {
 public:
  CaseFolder();
  ~CaseFolder();
  CaseFolder(const CaseFolder&) = delete;
  CaseFolder& operator=(const CaseFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  void copy_from(const std::filesystem::path& folder);  // its content
  void write(const std::string& file, const std::string& text) const;
  void append(const std::string& file, const std::string& text) const;
  std::string read(const std::string& file) const;

  /// Replaces the only occurrence of `before`.
  void replace(const std::string& file, const std::string& before, const std::string& after) const;

  /// A command line for the shell, in the folder, with OpenFOAM's environment and the library of
  /// this build; ended after 280 s.
  Outcome run(const std::string& command,
              const std::map<std::string, std::string>& more = {}) const;

  /// "mpirun ... -np N"
  static std::string mpirun(int ranks);

 private:
  std::filesystem::path path_;
};

/// One value per cell, or the one value of a uniform field, as ASCII OpenFOAM wrote it.
std::vector<std::vector<double>> read_field(const std::filesystem::path& file);

/// The template case of cases/channel-feedback without its function object, in `units` of
/// micrometres and milliseconds or of metres and seconds.
enum class Scale { micrometre, metre };
void make_channel(CaseFolder& folder, Scale scale, int cells_across);

/// The OpenFOAM library of this build.
std::filesystem::path library_file();

/// Why tests of this kind cannot run here; empty if they can.
std::string missing_openfoam();

}  // namespace hemoscale::test

/// Skips the test if there is no OpenFOAM or the plug-in was not built; fails it instead if the
/// environment variable REQUIRE_OPENFOAM is set.
#define HEMOSCALE_NEEDS_OPENFOAM()                                                         \
  if (const std::string missing = hemoscale::test::missing_openfoam(); !missing.empty()) { \
    if (std::getenv("REQUIRE_OPENFOAM") != nullptr) FAIL() << missing;                     \
    GTEST_SKIP() << missing;                                                               \
  }                                                                                        \
  static_assert(true, "")
