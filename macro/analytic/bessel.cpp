#include "macro/analytic/bessel.hpp"

#include <cassert>
#include <cmath>

namespace hemoscale::macro {

namespace {

using Complex = std::complex<double>;

constexpr double pi = 3.14159265358979323846;

// The terms (x^2 / 4)^k / (k!)^2 fall below rounding of the largest long before this k.
constexpr int series_terms = 80;

Complex sqrt_i() {
  return {std::sqrt(0.5), std::sqrt(0.5)};
}

ScaledBessel by_series(double x) {
  const Complex z = x * sqrt_i();
  const Complex quarter(0, 0.25 * x * x);  // z^2 / 4
  Complex term = 1;                        // (z^2 / 4)^k / (k!)^2
  Complex I0 = 0;
  Complex I1 = 0;
  for (int k = 0; k < series_terms; ++k) {
    I0 += term;
    I1 += term / (k + 1.0);
    term *= quarter / ((k + 1.0) * (k + 1.0));
  }
  const Complex scale = std::exp(-z);
  return {scale * I0, scale * 0.5 * z * I1};
}

struct Expansion {
  Complex growing;   // sum of (-1)^k a_k / z^k
  Complex decaying;  // sum of a_k / z^k
};

// Summed up to the smallest term, which lies near k = 2 |z| and is below rounding here.
Expansion asymptotic_sums(double order, Complex z) {
  Expansion sums;
  Complex term = 1;  // a_k(order) / z^k
  double sign = 1;
  for (int k = 1; k <= 40; ++k) {
    sums.growing += sign * term;
    sums.decaying += term;
    const double odd = 2 * k - 1;
    term *= (4 * order * order - odd * odd) / (8.0 * k * z);
    sign = -sign;
    if (std::abs(term) < 1e-18) break;
  }
  return sums;
}

// exp(-z) I_order(z) with the second exponential, which on this ray is smaller by exp(-2 Re z).
Complex asymptotic(double order, Complex z) {
  const Expansion sums = asymptotic_sums(order, z);
  const Complex phase = std::polar(1.0, (order + 0.5) * pi);
  return (sums.growing + phase * std::exp(-2.0 * z) * sums.decaying) / std::sqrt(2 * pi * z);
}

}  // namespace

ScaledBessel scaled_bessel(double x) {
  assert(x >= 0);
  if (x <= bessel_hand_over) return by_series(x);
  const Complex z = x * sqrt_i();
  return {asymptotic(0, z), asymptotic(1, z)};
}

std::complex<double> bessel_difference(double x, double xi) {
  assert(x >= 0 && x <= bessel_hand_over && xi >= 0 && xi <= 1);
  const Complex quarter(0, 0.25 * x * x);
  const double first = (1 - xi) * (1 + xi);
  Complex term = quarter;  // (z^2 / 4)^k / (k!)^2
  double power = 1;        // xi^(2 k - 2)
  double gap = 0;          // 1 - xi^(2 k), built up without subtraction
  Complex sum = 0;
  for (int k = 1; k < series_terms; ++k) {
    gap += power * first;
    sum += term * gap;
    power *= xi * xi;
    term *= quarter / ((k + 1.0) * (k + 1.0));
  }
  return sum;
}

}  // namespace hemoscale::macro
