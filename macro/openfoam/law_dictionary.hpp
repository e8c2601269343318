#pragma once

#include "dictionary.H"
#include "macro/openfoam/mesh_units.hpp"
#include "macro/viscosity/viscosity_law.hpp"

namespace hemoscale::macro {

/// What the viscosity model `hemoscale` needs to know before any law has arrived.
struct InitialLaw {
  ViscosityLaw law;
  double hematocrit = 0;  // [-] uniform
  MeshUnits units;
};

/// Reads `hemoscaleCoeffs`: the tables law, fluid and macro.openfoam of a case, with the same keys
/// and defaults, as dictionaries. All values are SI numbers; fluid.hematocrit and law.initial have
/// no default here.
///
///   law { initial newtonian; newtonian { viscosity 3.5e-3; } }
///   fluid { density 1050; hematocrit 0.4; }
///   macro { openfoam { length_unit 1e-6; time_unit 1e-3; } }
///
/// Ends with OpenFOAM's FatalIOError (file and line) on a missing, unknown or inadmissible entry.
InitialLaw read_initial_law(const Foam::dictionary& dictionary);

}  // namespace hemoscale::macro
