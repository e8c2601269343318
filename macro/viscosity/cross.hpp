#pragma once

namespace hemoscale::macro {

/// Two plateaus joined by the kinetics of links that shear breaks (Cross 1965):
///
///   mu = mu_inf + (mu0 - mu_inf) / (1 + (time g)^power)
///
/// with the shear rate g. Shear thickening if mu_inf > mu0. OpenFOAM's CrossPowerLaw is this law
/// with m = time and n = power.
struct Cross {
  double mu0 = 0;     // [Pa s] at zero shear rate, positive
  double mu_inf = 0;  // [Pa s] at infinite shear rate, not negative
  double time = 0;    // [s] positive
  double power = 0;   // [-] positive
};

/// @throws ParameterError naming the first parameter that is not admissible
void check(const Cross& law);

/// @param shear_rate  g, not negative [1/s]
/// @param hematocrit  not used: the parameters hold for one hematocrit [-]
/// @returns           dynamic viscosity [Pa s]
double viscosity(const Cross& law, double shear_rate, double hematocrit);

/// d(log viscosity) / d(log shear rate) [-].
double logarithmic_slope(const Cross& law, double shear_rate, double hematocrit);

}  // namespace hemoscale::macro
