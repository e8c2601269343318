#pragma once

namespace hemoscale::macro {

/// Two plateaus joined by a power law:
///
///   mu = mu_inf + (mu0 - mu_inf) [1 + (time g)^transition]^((power - 1) / transition)
///
/// with the shear rate g (Carreau 1972 for transition = 2; Yasuda, Armstrong and Cohen 1981).
struct CarreauYasuda {
  double mu0 = 0;         // [Pa s] at zero shear rate, positive
  double mu_inf = 0;      // [Pa s] at infinite shear rate, not negative
  double time = 0;        // [s] inverse of the shear rate where thinning sets in, positive
  double power = 1;       // [-] n, index of the power law between the plateaus, in [0, 1]
  double transition = 2;  // [-] a, sharpness of the first bend, positive
};

/// Human blood at 37 C and hematocrit about 0.45: mu0 = 56 mPa s, mu_inf = 3.45 mPa s,
/// time = 3.313 s, n = 0.3568, a = 2 (Cho and Kensey 1991). Published sets differ by 20 % above
/// 10 1/s and by a factor of 1.5 at 1 1/s: that is the uncertainty of any one of them.
CarreauYasuda cho_kensey_1991();

/// @throws ParameterError naming the first parameter that is not admissible
void check(const CarreauYasuda& law);

/// @param shear_rate  g, not negative [1/s]
/// @param hematocrit  not used: the parameters hold for one hematocrit [-]
/// @returns           dynamic viscosity [Pa s]
double viscosity(const CarreauYasuda& law, double shear_rate, double hematocrit);

/// d(log viscosity) / d(log shear rate) [-].
double logarithmic_slope(const CarreauYasuda& law, double shear_rate, double hematocrit);

}  // namespace hemoscale::macro
