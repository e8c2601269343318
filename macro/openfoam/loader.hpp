#pragma once

#include <filesystem>
#include <memory>

#include "macro/flow_field.hpp"
#include "macro/openfoam/case_reader.hpp"

namespace hemoscale::macro {

/// The OpenFOAM library of this project, loaded into a program that does not link OpenFOAM. It
/// stays loaded until the process ends.
class OpenFoamLibrary {
 public:
  /// Loads the library. Sets the environment variable WM_PROJECT_DIR if it is unset: OpenFOAM's
  /// libraries end the process without it.
  ///
  /// @param file  empty: $HEMOSCALE_OPENFOAM_LIBRARY, or libhemoscale_openfoam.so beside this
  ///              library or in ../lib of the program
  /// @throws EnvironmentError  the library is absent or cannot be loaded, OpenFOAM is absent or of
  ///                           another version than the library was compiled for
  explicit OpenFoamLibrary(const std::filesystem::path& file = {});

  const std::filesystem::path& file() const { return file_; }
  int version() const { return version_; }  // API number of openfoam.com, 1912 for v1912

  /// Opens a case folder and reads its flow at one time; no solver runs.
  /// @throws EnvironmentError, ParameterError  see hemoscale_open_case
  std::unique_ptr<FlowField<3>> open_case(const std::filesystem::path& folder,
                                          const CaseReading& reading) const;

  /// Reads the boundary of the plane mesh of a case folder.
  /// @throws EnvironmentError, ParameterError  see hemoscale_read_outline
  MeshOutline read_outline(const std::filesystem::path& folder, const CaseReading& reading) const;

 private:
  std::filesystem::path file_;
  int version_ = 0;
  decltype(&hemoscale_open_case) open_case_ = nullptr;
  decltype(&hemoscale_read_outline) read_outline_ = nullptr;
};

}  // namespace hemoscale::macro
