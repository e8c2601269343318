#pragma once

#include <string>

namespace hemoscale::coupling {

/// Whether the OpenFOAM library of this project can be loaded.
struct OpenFoamProbe {
  bool usable = false;
  std::string detail;  // file and version, or why not; one line
};

/// Tries in a child process: OpenFOAM's libraries end the process that loads them if they find
/// their surroundings wanting.
OpenFoamProbe probe_openfoam();

}  // namespace hemoscale::coupling
