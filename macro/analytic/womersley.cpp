#include "macro/analytic/womersley.hpp"

#include <cmath>
#include <complex>

#include "macro/analytic/bessel.hpp"
#include "macro/analytic/poiseuille.hpp"
#include "macro/parameter_check.hpp"

namespace hemoscale::macro {

namespace {

using Complex = std::complex<double>;

constexpr double lowest_alpha = 1e-3;
constexpr double highest_alpha = 1e4;

// Complex amplitude of the velocity over G b^2 / mu (b: half-height or radius) and its derivative
// with respect to the distance from the axis over b.
struct Amplitude {
  Complex value;
  Complex slope;
};

Complex root(double alpha) {
  return alpha * Complex(std::sqrt(0.5), std::sqrt(0.5));
}

// exp(-z) - 1 without cancellation, Re z >= 0.
Complex expm1_of_minus(Complex z) {
  const double half_sine = std::sin(0.5 * z.imag());
  const double real = std::expm1(-z.real()) * std::cos(z.imag()) - 2 * half_sine * half_sine;
  return {real, -std::exp(-z.real()) * std::sin(z.imag())};
}

// [1 - cosh(q eta) / cosh q] / q^2 with 1 - cosh(q eta) / cosh q written as
// 2 sinh(a) sinh(b) / cosh(a + b), a = q (1 - eta) / 2, b = q (1 + eta) / 2: nothing cancels for
// small q, nothing overflows for large q.
//
// from_wall = 1 - eta for the distance eta = 0 to 1 from the axis.
Amplitude channel_amplitude(double alpha, double from_wall) {
  const Complex q = root(alpha);
  const double eta = 1 - from_wall;
  const Complex below = 1.0 + std::exp(-2.0 * q);
  const Complex value = expm1_of_minus(q * from_wall) * expm1_of_minus(q * (1 + eta)) / below;
  // -sinh(q eta) / cosh q
  const Complex slope = std::exp(-q * from_wall) * expm1_of_minus(2.0 * q * eta) / below;
  return {value / (q * q), slope / q};
}

// [1 - I_0(q xi) / I_0(q)] / q^2; the scaled values beyond the range of the series, where their
// difference cancels only within a thin layer at the wall and then to rounding of the wall value.
Amplitude pipe_amplitude(double alpha, double xi) {
  const Complex q = root(alpha);
  const ScaledBessel wall = scaled_bessel(alpha);
  const ScaledBessel here = scaled_bessel(alpha * xi);
  const Complex decay = std::exp(-q * (1 - xi));
  const Complex value = alpha <= bessel_hand_over
                            ? bessel_difference(alpha, xi) * std::exp(-q) / wall.I0
                            : 1.0 - decay * here.I0 / wall.I0;
  return {value / (q * q), -decay * here.I1 / (wall.I0 * q)};
}

template <typename Profile>
void check_pulsation(const char* owner, const Profile& profile) {
  require_finite({owner, "steady_gradient", profile.steady_gradient, "Pa/m"},
                 "give the mean of -dp/dx");
  require_finite({owner, "oscillating_gradient", profile.oscillating_gradient, "Pa/m"},
                 "give the amplitude of -dp/dx");
  require_positive({owner, "angular_frequency", profile.angular_frequency, "rad/s"},
                   "use a Poiseuille flow for a steady pressure gradient");
  require_positive({owner, "viscosity", profile.viscosity, "Pa s"}, "give the dynamic viscosity");
  require_positive({owner, "density", profile.density, "kg/m^3"}, "blood has about 1060 kg/m^3");
  const double alpha = womersley_number(profile);
  require(alpha >= lowest_alpha && alpha <= highest_alpha, {owner, "Womersley number", alpha, "-"},
          "1e-3 to 1e4", "use a Poiseuille flow below; above, check the units of the frequency");
}

template <typename Profile>
double viscous_width(const Profile& profile) {  // thickness of the oscillating layer [m]
  return std::sqrt(profile.viscosity / (profile.angular_frequency * profile.density));
}

template <typename Profile>
ProfilePoint add(const ProfilePoint& steady, const Profile& profile, const Amplitude& amplitude,
                 double half_width, double t) {
  const double phase = profile.angular_frequency * t;
  const Complex rotation = std::polar(1.0, phase);
  const double scale = profile.oscillating_gradient * half_width / profile.viscosity;  // [1/s]
  return {steady.velocity + scale * half_width * (amplitude.value * rotation).real(),
          steady.gradient + scale * (amplitude.slope * rotation).real(),
          steady.pressure_gradient + profile.oscillating_gradient * std::cos(phase)};
}

}  // namespace

double womersley_number(const WomersleyChannelProfile& profile) {
  return 0.5 * profile.height / viscous_width(profile);
}

double womersley_number(const WomersleyPipeProfile& profile) {
  return profile.radius / viscous_width(profile);
}

void check(const WomersleyChannelProfile& profile) {
  const char* owner = "Womersley channel flow";
  require_positive({owner, "height", profile.height, "m"}, "give the distance between the walls");
  check_pulsation(owner, profile);
}

void check(const WomersleyPipeProfile& profile) {
  const char* owner = "Womersley pipe flow";
  require_positive({owner, "radius", profile.radius, "m"}, "give the inner radius of the pipe");
  check_pulsation(owner, profile);
}

ProfilePoint evaluate(const WomersleyChannelProfile& profile, double y, double t) {
  const double b = 0.5 * profile.height;
  const bool upper = y > b;
  const double from_wall = (upper ? profile.height - y : y) / b;
  Amplitude amplitude = channel_amplitude(womersley_number(profile), from_wall);
  if (!upper) amplitude.slope = -amplitude.slope;  // eta grows downwards there
  const PlanePoiseuilleProfile steady{profile.height, profile.steady_gradient, profile.viscosity};
  return add(evaluate(steady, y, t), profile, amplitude, b, t);
}

ProfilePoint evaluate(const WomersleyPipeProfile& profile, double r, double t) {
  const double xi = r / profile.radius;
  const Amplitude amplitude = pipe_amplitude(womersley_number(profile), xi);
  const PipePoiseuilleProfile steady{profile.radius, profile.steady_gradient, profile.viscosity};
  return add(evaluate(steady, r, t), profile, amplitude, profile.radius, t);
}

}  // namespace hemoscale::macro
