#pragma once

#include <complex>

namespace hemoscale::macro {

/// Modified Bessel functions of the first kind along the ray arg z = pi / 4, scaled by exp(-z):
/// I_0 and I_1 of z = sqrt(i) x (Kelvin's ber and bei in another dress).
struct ScaledBessel {
  std::complex<double> I0;  // exp(-z) I_0(z)
  std::complex<double> I1;  // exp(-z) I_1(z)
};

/// Power series (DLMF 10.25.2) up to x = 18, beyond it both exponentials of the asymptotic
/// expansion (DLMF 10.40.5). Relative error below 2e-13, largest just below x = 18, where the terms
/// of the series cancel.
///
/// @param x  not negative; |z| [-]
ScaledBessel scaled_bessel(double x);

/// I_0(q) - I_0(q xi) for q = sqrt(i) x by the power series, without the cancellation that the
/// difference of two values has for small x or for xi near 1.
///
/// @param x   0 to 18
/// @param xi  0 to 1
std::complex<double> bessel_difference(double x, double xi);

/// Where the power series hands over to the asymptotic expansion [-].
constexpr double bessel_hand_over = 18;

}  // namespace hemoscale::macro
