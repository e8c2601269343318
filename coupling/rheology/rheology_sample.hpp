#pragma once

#include <string>

namespace hemoscale::coupling {

/// One measured point of the rheology of a suspension.
struct RheologySample {
  double shear_rate = 0;               // [1/s] sqrt(2 D:D)
  double hematocrit = 0;               // [-]
  double shear_stress = 0;             // [Pa] total
  double viscosity = 0;                // [Pa s] shear_stress / shear_rate
  double viscosity_error = 0;          // [Pa s] standard error of viscosity
  double first_normal_difference = 0;  // [Pa]
  double first_normal_error = 0;       // [Pa] standard error
  double effective_samples = 0;        // [-] behind the standard error
  double averaging_time = 0;           // [s]
  bool precision_reached = false;      // false: the allowance was spent first
  int dimension = 2;                   // of the micro model: 2-D viscosity is not 3-D viscosity
};

}  // namespace hemoscale::coupling
