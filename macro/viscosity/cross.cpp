#include "macro/viscosity/cross.hpp"

#include <cmath>

#include "macro/parameter_check.hpp"

namespace hemoscale::macro {

namespace {

// 1 / (1 + x^m), with x^-m beyond x = 1 so that nothing overflows (floating-point traps).
double intact_links(const Cross& law, double x) {
  if (x > 1) {
    const double small = std::pow(x, -law.power);
    return small / (1 + small);
  }
  return 1 / (1 + std::pow(x, law.power));
}

}  // namespace

void check(const Cross& law) {
  const char* owner = "Cross law";
  require_positive({owner, "mu0", law.mu0, "Pa s"}, "give the viscosity at zero shear rate");
  require_not_negative({owner, "mu_inf", law.mu_inf, "Pa s"},
                       "give the viscosity at infinite shear rate");
  require_positive({owner, "time", law.time, "s"},
                   "give the inverse of the shear rate halfway between the plateaus");
  require_positive({owner, "power", law.power, "-"}, "usual values lie between 0.5 and 1");
}

double viscosity(const Cross& law, double shear_rate, double /*hematocrit*/) {
  return law.mu_inf + (law.mu0 - law.mu_inf) * intact_links(law, law.time * shear_rate);
}

double logarithmic_slope(const Cross& law, double shear_rate, double hematocrit) {
  const double intact = intact_links(law, law.time * shear_rate);
  return -(law.mu0 - law.mu_inf) * intact * law.power * (1 - intact) /
         viscosity(law, shear_rate, hematocrit);
}

}  // namespace hemoscale::macro
