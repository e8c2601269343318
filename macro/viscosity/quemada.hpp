#pragma once

namespace hemoscale::macro {

/// Concentrated dispersion whose effective crowding falls with shear (Quemada 1978):
///
///   mu = plasma_viscosity (1 - k H / 2)^-2,   k = (k0 + k_inf r) / (1 + r),   r = sqrt(g / g_c)
///
/// with the hematocrit H and the shear rate g. Valid while k H < 2; at k H = 2 the cells are packed
/// and the viscosity is infinite.
struct Quemada {
  double plasma_viscosity = 0;     // [Pa s] positive
  double k0 = 0;                   // [-] intrinsic viscosity at zero shear rate, not negative
  double k_inf = 0;                // [-] the same at infinite shear rate, not negative
  double critical_shear_rate = 0;  // [1/s] g_c, positive
};

/// Parameters for human blood as functions of the hematocrit, with polynomials of the kind of
/// Cokelet (1987) in the exponents:
///
///   k0    = exp( 3.874  - 10.41  H + 13.8  H^2 - 6.738  H^3)
///   k_inf = exp( 1.3435 -  2.803 H +  2.711 H^2 - 0.6479 H^3)
///   g_c   = exp(-6.1508 + 27.923 H - 25.6  H^2 + 3.697  H^3)  [1/s]
///
/// The law that results holds at this hematocrit only.
///
/// @param plasma_viscosity  positive [Pa s]
/// @param hematocrit        0 to 0.6, the range of the measurements [-]
/// @throws ParameterError outside these ranges
Quemada quemada_cokelet(double plasma_viscosity, double hematocrit);

/// @throws ParameterError naming the first parameter that is not admissible
void check(const Quemada& law);

/// @param shear_rate  g, not negative [1/s]
/// @param hematocrit  H, not negative, k H < 2 [-]
/// @returns           dynamic viscosity [Pa s]
/// @throws ParameterError where the cells are packed (k H >= 2) or the hematocrit is negative
double viscosity(const Quemada& law, double shear_rate, double hematocrit);

/// d(log viscosity) / d(log shear rate) [-].
/// @throws ParameterError as viscosity()
double logarithmic_slope(const Quemada& law, double shear_rate, double hematocrit);

}  // namespace hemoscale::macro
