#pragma once

#include <string>

#include "coupling/config/settings.hpp"
#include "macro/viscosity/viscosity_law.hpp"

namespace hemoscale::coupling {

/// The viscosity law that a case names.
///
/// @param settings    a checked case
/// @param choice_key  key that names the law, e.g. "law.initial"
/// @param section     where its parameters stand, e.g. "law": "law.carreau_yasuda.time"
/// @throws CaseError with the place of the section if the parameters do not fit together
macro::ViscosityLaw build_law(const Settings& settings, const std::string& choice_key,
                              const std::string& section);

}  // namespace hemoscale::coupling
