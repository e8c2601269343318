#pragma once

#include "coupling/config/settings.hpp"
#include "dictionary.H"
#include "fileName.H"

namespace hemoscale::coupling {

/// What the dictionary of the function object says.
struct PluginSettings {
  Settings settings;       // the checked case
  Foam::fileName results;  // folder for results, absolute
  bool restart = false;    // continue from the newest checkpoint there
};

/// Reads the dictionary of the function object `hemoscale`:
///
///   type      hemoscale;
///   libs      (libhemoscale_openfoam.so);
///   results   "results";            // default; relative to the OpenFOAM case
///   restart   no;                   // default
///   case      "../case.toml";       // either a case file, relative to the OpenFOAM case,
///   variant   openfoam;             //   and one of its variants,
///   fluid { hematocrit 0.4; } ...   // or the keys of a case as sub-dictionaries
///
/// Environment variables in case, variant, results and restart are expanded by OpenFOAM's rules,
/// ${NAME:-default} included. Inside a solver macro.model is openfoam, and macro.openfoam.case is
/// the case that runs: inline keys need not say so.
///
/// @param openfoam_case  folder of the case, not of a processor
/// @throws CaseError, EnvironmentError  and OpenFOAM's own errors for entries of the wrong type
PluginSettings read_plugin_settings(const Foam::dictionary& dictionary,
                                    const Foam::fileName& openfoam_case);

}  // namespace hemoscale::coupling
