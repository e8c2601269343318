#pragma once

#include "coupling/config/settings.hpp"
#include "micro/mps/plasma_model.hpp"

namespace hemoscale::coupling {

/// The method of a plasma case: its scheme, changed by the single choices that are given.
/// @throws CaseError naming every choice that the operators cannot take, and what they can;
///         micro::ParameterError for choices that exclude each other
micro::PlasmaMethod build_plasma_method(const Settings& settings);

inline bool is_explicit_in_viscosity(const micro::StageOptions& options) {
  return options.viscosity == micro::ViscosityTreatment::explicit_euler;
}
inline bool is_explicit_in_viscosity(const micro::SemiImplicitOptions& options) {
  return options.viscosity == micro::ViscousStepping::explicit_euler;
}

}  // namespace hemoscale::coupling
