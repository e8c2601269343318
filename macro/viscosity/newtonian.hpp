#pragma once

namespace hemoscale::macro {

/// Constant viscosity: plasma (about 1.2e-3 Pa s at 37 C), or blood at high shear rate.
struct Newtonian {
  double mu = 0;  // [Pa s] positive
};

/// @throws ParameterError naming the first parameter that is not admissible
void check(const Newtonian& law);

/// @param shear_rate  not used; any value not negative [1/s]
/// @param hematocrit  not used [-]
/// @returns           dynamic viscosity [Pa s]
double viscosity(const Newtonian& law, double shear_rate, double hematocrit);

/// d(log viscosity) / d(log shear rate) [-]: zero.
double logarithmic_slope(const Newtonian& law, double shear_rate, double hematocrit);

}  // namespace hemoscale::macro
