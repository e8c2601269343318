#pragma once

namespace hemoscale::macro {

/// A yield stress and a constant viscosity far above it:
///
///   sqrt(tau) = sqrt(yield_stress) + sqrt(mu_inf g),   mu = tau / g     (Casson 1959)
///
/// with the shear rate g. mu grows without bound as g tends to zero; below `lowest_shear_rate` its
/// value there is held, so that the fluid creeps like a Newtonian one instead of being rigid. A
/// channel's plug then moves with an error that vanishes with this parameter.
///
/// Blood at hematocrit 0.45: yield stress about 4e-3 to 6e-3 Pa, mu_inf about 3.5e-3 Pa s.
struct Casson {
  double yield_stress = 0;       // [Pa] not negative
  double mu_inf = 0;             // [Pa s] positive
  double lowest_shear_rate = 0;  // [1/s] positive; below it the viscosity is held
};

/// @throws ParameterError naming the first parameter that is not admissible
void check(const Casson& law);

/// @param shear_rate  g, not negative [1/s]
/// @param hematocrit  not used: the parameters hold for one hematocrit [-]
/// @returns           dynamic viscosity [Pa s]
double viscosity(const Casson& law, double shear_rate, double hematocrit);

/// d(log viscosity) / d(log shear rate) [-]; zero below the lowest shear rate.
double logarithmic_slope(const Casson& law, double shear_rate, double hematocrit);

}  // namespace hemoscale::macro
