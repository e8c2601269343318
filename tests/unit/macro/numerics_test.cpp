#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "macro/analytic/bessel.hpp"
#include "macro/analytic/bracketed_root.hpp"
#include "macro/analytic/gauss_legendre.hpp"

namespace hemoscale::macro {
namespace {

TEST(BracketedRoot, finds_a_simple_root_to_rounding) {
  const auto cubic = [](double x) { return ValueAndSlope{x * x * x - 2, 3 * x * x}; };
  EXPECT_NEAR(bracketed_root(cubic, 0, 10, 0), std::cbrt(2.0), 4e-16);
}

TEST(BracketedRoot, survives_flat_pieces_and_steep_ones) {
  int calls = 0;
  const auto steep = [&calls](double x) {
    ++calls;
    return ValueAndSlope{std::tanh(1e3 * (x - 0.7)), 1e3 / std::pow(std::cosh(1e3 * (x - 0.7)), 2)};
  };
  EXPECT_NEAR(bracketed_root(steep, 0, 1, 0), 0.7, 1e-15);
  EXPECT_LT(calls, 100);
}

TEST(BracketedRoot, survives_a_slope_of_zero_and_a_wrong_one) {
  const auto no_slope = [](double x) { return ValueAndSlope{x - 0.3, 0}; };
  EXPECT_NEAR(bracketed_root(no_slope, 0, 1, 0), 0.3, 1e-15);
  const auto wrong = [](double x) { return ValueAndSlope{x - 0.3, -1}; };
  EXPECT_NEAR(bracketed_root(wrong, 0, 1, 0), 0.3, 1e-15);
}

TEST(BracketedRoot, returns_the_upper_end_of_a_bracket_without_inside) {
  const double high = std::nextafter(1.0, 2.0);
  const auto line = [](double x) { return ValueAndSlope{x - 1.5, 1}; };
  EXPECT_EQ(bracketed_root(line, 1.0, high, 0), high);
}

TEST(GaussLegendre, is_exact_up_to_degree_31_and_not_beyond) {
  const GaussLegendre rule = gauss_legendre();
  const auto error = [&rule](int degree) {
    const auto power = [degree](double x) { return std::pow(x, degree); };
    return std::abs(integrate(rule, power, 0, 1) - 1.0 / (degree + 1));
  };
  for (int degree = 0; degree <= 31; ++degree) EXPECT_LT(error(degree), 1e-15) << degree;
  // The error on (0, 1) for degree 32 is (16!)^4 / (33 (32!)^2) = 1.6e-20: too small to see, so the
  // limit shows on a long interval, where it is 2^33 times as large and more.
  const auto power = [](double x) { return std::pow(x, 60); };
  EXPECT_GT(std::abs(integrate(rule, power, -1, 1) - 2.0 / 61), 1e-12);
}

// Power series in extended precision, independent of the hand-over.
struct LongBessel {
  std::complex<long double> I0;
  std::complex<long double> I1;
};
LongBessel long_series(double x) {
  const long double square = static_cast<long double>(x) * static_cast<long double>(x);
  const std::complex<long double> quarter(0, square / 4);
  const long double part = static_cast<long double>(x) * std::sqrt(0.5L);
  const std::complex<long double> z(part, part);
  std::complex<long double> term = 1;
  LongBessel sum{0, 0};
  for (int k = 0; k < 200; ++k) {
    const long double next = k + 1;
    sum.I0 += term;
    sum.I1 += term / next;
    term *= quarter / (next * next);
  }
  const std::complex<long double> scale = std::exp(-z);
  return {scale * sum.I0, scale * sum.I1 * z / 2.0L};
}

TEST(Bessel, agrees_with_the_series_in_extended_precision_on_both_sides_of_the_hand_over) {
  for (const double x : {0.0, 1e-3, 0.5, 3.0, 9.0, 15.0, 17.99, 18.01, 20.0, 25.0, 30.0}) {
    const ScaledBessel here = scaled_bessel(x);
    const LongBessel there = long_series(x);
    const std::complex<double> I0(there.I0);
    const std::complex<double> I1(there.I1);
    EXPECT_LT(std::abs(here.I0 - I0), 2e-13 * std::abs(I0)) << x;
    EXPECT_LE(std::abs(here.I1 - I1), 2e-13 * std::abs(I1)) << x;
  }
}

TEST(Bessel, difference_is_that_of_the_values) {
  for (const double x : {0.5, 4.0, 12.0}) {
    for (const double xi : {0.0, 0.3, 0.9}) {
      const double part = x * std::sqrt(0.5);
      const std::complex<double> z(part, part);
      const std::complex<double> values =
          std::exp(z) * scaled_bessel(x).I0 - std::exp(xi * z) * scaled_bessel(x * xi).I0;
      EXPECT_LT(std::abs(bessel_difference(x, xi) - values), 1e-12 * std::abs(std::exp(z)));
    }
  }
}

// The series of the difference in extended precision, with 1 - xi^(2 k) from the logarithm.
std::complex<long double> long_difference(double x, double xi) {
  const long double square = static_cast<long double>(x) * static_cast<long double>(x);
  const std::complex<long double> quarter(0, square / 4);
  std::complex<long double> term = 1;
  std::complex<long double> sum = 0;
  for (int k = 1; k < 200; ++k) {
    term *= quarter / (static_cast<long double>(k) * k);
    sum -= term * std::expm1(2.0L * k * std::log1p(static_cast<long double>(xi) - 1));
  }
  return sum;
}

TEST(Bessel, difference_keeps_its_relative_accuracy_for_small_arguments_and_at_the_wall) {
  // Leading term (z^2 / 4) (1 - xi^2).
  const std::complex<double> small = bessel_difference(1e-6, 0.5);
  EXPECT_NEAR(small.imag() / (0.25e-12 * 0.75), 1, 1e-11);
  for (const double xi : {0.9, 1 - 1e-5, 1 - 1e-7, 1 - 1e-10}) {
    for (const double x : {0.1, 2.0, 15.0}) {
      const std::complex<double> exact(long_difference(x, xi));
      EXPECT_LT(std::abs(bessel_difference(x, xi) - exact), 2e-13 * std::abs(exact)) << x;
    }
  }
  EXPECT_EQ(std::abs(bessel_difference(2, 1)), 0);
}

}  // namespace
}  // namespace hemoscale::macro
