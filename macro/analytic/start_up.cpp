#include "macro/analytic/start_up.hpp"

#include <cmath>

#include "macro/parameter_check.hpp"

namespace hemoscale::macro {

namespace {

constexpr double pi = 3.14159265358979323846;

// nu t / h^2 at which the image sums hand over to the eigenfunction series [-].
constexpr double hand_over = 0.1;

// Terms that reach rounding: exp(-(2n+1)^2 pi^2 0.1) and erfc(n / (2 sqrt(0.1))) both fall below
// 1e-17 of the leading one before this index.
constexpr int terms = 8;

// Velocity over its scale and its derivative with respect to eta = y / h.
struct Shape {
  double value = 0;
  double slope = 0;
};

// Repeated integrals of the complementary error function (Carslaw and Jaeger 1959, appendix II):
// ierfc = int_z^inf erfc, i2erfc = int_z^inf ierfc.
double ierfc(double z) {
  return std::exp(-z * z) / std::sqrt(pi) - z * std::erfc(z);
}
double i2erfc(double z) {
  return 0.25 * (std::erfc(z) - 2 * z * ierfc(z));
}

// u mu / (G h^2) for small T = nu t / h^2: T [1 - 4 sum (-1)^n (i2erfc(a_n) + i2erfc(b_n))] with
// the distances a_n = (n + eta) / (2 sqrt T) to the images of the lower wall, b_n to those of the
// upper.
Shape poiseuille_by_images(double eta, double T) {
  const double width = 2 * std::sqrt(T);
  Shape sum;
  double sign = 1;
  for (int n = 0; n < terms; ++n, sign = -sign) {
    const double a = (n + eta) / width;
    const double b = (n + (1 - eta)) / width;
    sum.value += sign * (i2erfc(a) + i2erfc(b));
    sum.slope += sign * (ierfc(b) - ierfc(a)) / width;
  }
  return {T * (1 - 4 * sum.value), -4 * T * sum.slope};
}

Shape poiseuille_by_series(double eta, double T) {
  // Measured from the nearer wall, so that both walls give exactly zero.
  const double near = eta <= 0.5 ? eta : 1 - eta;
  Shape sum;
  for (int n = 0; n < terms; ++n) {
    const double k = (2 * n + 1) * pi;
    const double decay = std::exp(-k * k * T) / (k * k);
    sum.value += decay / k * std::sin(k * near);
    sum.slope += decay * std::cos(k * near);
  }
  const double slope = 0.5 * (1 - 2 * near) - 4 * sum.slope;
  return {0.5 * near * (1 - near) - 4 * sum.value, eta <= 0.5 ? slope : -slope};
}

// u / U for small T: sum of erfc((2n + 1 - eta) / w) - erfc((2n + 1 + eta) / w), w = 2 sqrt T.
Shape couette_by_images(double eta, double T) {
  const double width = 2 * std::sqrt(T);
  Shape sum;
  for (int n = 0; n < terms; ++n) {
    const double a = (2 * n + (1 - eta)) / width;
    const double b = (2 * n + 1 + eta) / width;
    sum.value += std::erfc(a) - std::erfc(b);
    sum.slope += 2 / (width * std::sqrt(pi)) * (std::exp(-a * a) + std::exp(-b * b));
  }
  return sum;
}

Shape couette_by_series(double eta, double T) {
  // With the distance from the moving wall (-1)^k sin(k pi eta) is -sin(k pi (1 - eta)), which is
  // exactly zero there.
  const double from_moving_wall = 1 - eta;
  Shape sum;
  for (int n = 1; n <= 2 * terms; ++n) {
    const double k = n * pi;
    const double decay = std::exp(-k * k * T);
    sum.value += decay / k * std::sin(k * from_moving_wall);
    sum.slope += decay * std::cos(k * from_moving_wall);
  }
  return {eta - 2 * sum.value, 1 + 2 * sum.slope};
}

void check_fluid(const char* owner, double height, double viscosity, double density) {
  require_positive({owner, "height", height, "m"}, "give the distance between the walls");
  require_positive({owner, "viscosity", viscosity, "Pa s"}, "give the dynamic viscosity");
  require_positive({owner, "density", density, "kg/m^3"}, "blood has about 1060 kg/m^3");
}

}  // namespace

void check(const StartUpPoiseuilleProfile& profile) {
  const char* owner = "start-up Poiseuille flow";
  check_fluid(owner, profile.height, profile.viscosity, profile.density);
  require_finite({owner, "pressure_gradient", profile.pressure_gradient, "Pa/m"}, "give -dp/dx");
}

void check(const StartUpCouetteProfile& profile) {
  const char* owner = "start-up Couette flow";
  check_fluid(owner, profile.height, profile.viscosity, profile.density);
  require_finite({owner, "wall_velocity", profile.wall_velocity, "m/s"},
                 "give the velocity of the wall y = height");
}

ProfilePoint evaluate(const StartUpPoiseuilleProfile& profile, double y, double t) {
  if (t < 0) return {};
  const double G = profile.pressure_gradient;
  if (t == 0) return {0, 0, G};
  const double h = profile.height;
  const double T = profile.viscosity * t / (profile.density * h * h);
  const Shape shape =
      T < hand_over ? poiseuille_by_images(y / h, T) : poiseuille_by_series(y / h, T);
  const double scale = G * h / profile.viscosity;  // [1/s]
  return {scale * h * shape.value, scale * shape.slope, G};
}

ProfilePoint evaluate(const StartUpCouetteProfile& profile, double y, double t) {
  if (t <= 0) return {};
  const double h = profile.height;
  const double T = profile.viscosity * t / (profile.density * h * h);
  const Shape shape = T < hand_over ? couette_by_images(y / h, T) : couette_by_series(y / h, T);
  const double U = profile.wall_velocity;
  return {U * shape.value, U / h * shape.slope, 0};
}

}  // namespace hemoscale::macro
