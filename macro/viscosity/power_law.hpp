#pragma once

namespace hemoscale::macro {

/// mu = consistency g^(power - 1) with the shear rate g (Ostwald 1925; de Waele 1923). The law has
/// no plateaus of its own: outside [lowest_shear_rate, highest_shear_rate] the value at the bound
/// is held.
struct PowerLaw {
  double consistency = 0;         // [Pa s^power] positive
  double power = 0;               // [-] n, positive; below 1 thinning, above 1 thickening
  double lowest_shear_rate = 0;   // [1/s] positive
  double highest_shear_rate = 0;  // [1/s] above the lowest
};

/// @throws ParameterError naming the first parameter that is not admissible
void check(const PowerLaw& law);

/// @param shear_rate  g, not negative [1/s]
/// @param hematocrit  not used: the parameters hold for one hematocrit [-]
/// @returns           dynamic viscosity [Pa s]
double viscosity(const PowerLaw& law, double shear_rate, double hematocrit);

/// d(log viscosity) / d(log shear rate) [-]: power - 1 inside the bounds, zero outside.
double logarithmic_slope(const PowerLaw& law, double shear_rate, double hematocrit);

}  // namespace hemoscale::macro
