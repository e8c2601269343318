#include "macro/viscosity/quemada.hpp"

#include <cmath>

#include "macro/parameter_check.hpp"

namespace hemoscale::macro {

namespace {

double crowding(const Quemada& law, double r) {
  return (law.k0 + law.k_inf * r) / (1 + r);
}

double root_of_shear_rate(const Quemada& law, double shear_rate) {
  return std::sqrt(shear_rate / law.critical_shear_rate);
}

[[noreturn]] void throw_packed(double k, double hematocrit) {
  const std::string allowed =
      k > 0 ? "0 to less than " + as_text(2 / k) + " (= 2 / k, where the cells are packed)"
            : "not negative";
  refuse({"Quemada law", "hematocrit", hematocrit, "-"}, allowed,
         "lower the hematocrit, or use k0 and k_inf fitted at this hematocrit");
}

// 1 - k H / 2 [-], positive while there is plasma left between the cells. NaN from a diverged flow
// passes on as NaN: the solver that made it reports it better.
double free_fraction(double k, double hematocrit) {
  const double fraction = 1 - 0.5 * k * hematocrit;
  if (fraction <= 0 || hematocrit < 0) throw_packed(k, hematocrit);
  return fraction;
}

double cubic(double a, double b, double c, double d, double x) {
  return a + x * (b + x * (c + x * d));
}

}  // namespace

Quemada quemada_cokelet(double plasma_viscosity, double hematocrit) {
  const double H = hematocrit;
  require(H >= 0 && H <= 0.6, {"Quemada-Cokelet law", "hematocrit", H, "-"}, "0 to 0.6",
          "the correlations were fitted in this range; give k0, k_inf and critical_shear_rate");
  const Quemada law{plasma_viscosity, std::exp(cubic(3.874, -10.41, 13.8, -6.738, H)),
                    std::exp(cubic(1.3435, -2.803, 2.711, -0.6479, H)),
                    std::exp(cubic(-6.1508, 27.923, -25.6, 3.697, H))};
  check(law);
  return law;
}

void check(const Quemada& law) {
  const char* owner = "Quemada law";
  require_positive({owner, "plasma_viscosity", law.plasma_viscosity, "Pa s"},
                   "plasma has about 1.2e-3 Pa s at 37 C");
  require_not_negative({owner, "k0", law.k0, "-"}, "blood has about 4 at hematocrit 0.45");
  require_not_negative({owner, "k_inf", law.k_inf, "-"}, "blood has about 2 at hematocrit 0.45");
  require_positive({owner, "critical_shear_rate", law.critical_shear_rate, "1/s"},
                   "blood has about 2 1/s at hematocrit 0.45");
}

double viscosity(const Quemada& law, double shear_rate, double hematocrit) {
  const double k = crowding(law, root_of_shear_rate(law, shear_rate));
  const double fraction = free_fraction(k, hematocrit);
  return law.plasma_viscosity / (fraction * fraction);
}

double logarithmic_slope(const Quemada& law, double shear_rate, double hematocrit) {
  const double r = root_of_shear_rate(law, shear_rate);
  const double k_slope = 0.5 * (law.k_inf - law.k0) * (r / (1 + r)) / (1 + r);
  return hematocrit * k_slope / free_fraction(crowding(law, r), hematocrit);
}

}  // namespace hemoscale::macro
