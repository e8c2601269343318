#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "macro/flow_field.hpp"
#include "macro/openfoam/interpolation.hpp"
#include "macro/openfoam/mesh_outline.hpp"
#include "macro/openfoam/mesh_units.hpp"

/// The boundary between the program, which must not link OpenFOAM, and the library that does. It
/// holds no type of OpenFOAM; loader.hpp opens the library and calls through it.
namespace hemoscale::macro {

/// How to read a case folder.
struct CaseReading {
  std::string time;  // name of the time folder; empty: the latest
  std::string velocity_field = "U";
  std::string pressure_field = "p";  // empty: no pressure is read, that of every state is zero
  MeshUnits units;
  Interpolation interpolation = Interpolation::taylor;
  /// Read a decomposed case, one part per rank of the world communicator. MPI is initialised by the
  /// caller; the call and every use of the field are collective.
  bool decomposed = false;
};

}  // namespace hemoscale::macro

extern "C" {

/// Opens a case folder of OpenFOAM and reads its flow at one time; no solver runs. The caller owns
/// the result. `WM_PROJECT_DIR` must be set when the library is loaded.
///
/// @throws macro::EnvironmentError  the folder is not a case, no mesh, no such time, no such field,
///                                  decomposed for another number of ranks; or OpenFOAM's message
/// @throws macro::ParameterError    units that are not positive, interpolation that cannot work
hemoscale::macro::FlowField<3>* hemoscale_open_case(const std::filesystem::path* folder,
                                                    const hemoscale::macro::CaseReading* reading);

/// Reads the boundary of the plane mesh of a case folder. The caller owns the result. Every process
/// that calls it reads the whole mesh: `decomposed` must be false.
///
/// @throws macro::EnvironmentError  the folder is not a case, no mesh; or OpenFOAM's message
/// @throws macro::ParameterError    units that are not positive, a mesh that is not plane in x and
/// y
hemoscale::macro::MeshOutline* hemoscale_read_outline(const std::filesystem::path* folder,
                                                      const hemoscale::macro::CaseReading* reading);

/// API number of OpenFOAM (1912 for v1912) that the library was compiled against.
int hemoscale_openfoam_compiled_version();

/// API number of the OpenFOAM libraries that it runs with.
int hemoscale_openfoam_running_version();
}
