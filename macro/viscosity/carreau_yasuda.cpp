#include "macro/viscosity/carreau_yasuda.hpp"

#include <cmath>

#include "macro/parameter_check.hpp"

namespace hemoscale::macro {

namespace {

struct Bend {
  double factor;  // [1 + x^a]^((n - 1) / a) [-]
  double weight;  // x^a / (1 + x^a) [-]
};

// Written with x^-a beyond the bend, so that no intermediate value overflows where the result is
// finite: a host with floating-point traps would end the run otherwise.
Bend bend(const CarreauYasuda& law, double x) {
  const double exponent = (law.power - 1) / law.transition;
  if (x > 1) {
    const double small = std::pow(x, -law.transition);
    return {std::pow(x, law.power - 1) * std::pow(1 + small, exponent), 1 / (1 + small)};
  }
  const double small = std::pow(x, law.transition);
  return {std::pow(1 + small, exponent), small / (1 + small)};
}

}  // namespace

CarreauYasuda cho_kensey_1991() {
  return {56e-3, 3.45e-3, 3.313, 0.3568, 2};
}

void check(const CarreauYasuda& law) {
  const char* owner = "Carreau-Yasuda law";
  require_positive({owner, "mu0", law.mu0, "Pa s"}, "give the viscosity at zero shear rate");
  require_not_negative({owner, "mu_inf", law.mu_inf, "Pa s"},
                       "give the viscosity at infinite shear rate");
  require_positive({owner, "time", law.time, "s"},
                   "give the inverse of the shear rate where thinning sets in");
  require(law.power >= 0 && law.power <= 1, {owner, "power", law.power, "-"}, "0 to 1",
          "use 1 for a Newtonian fluid and less for shear thinning");
  require_positive({owner, "transition", law.transition, "-"}, "use 2 for the Carreau law");
}

double viscosity(const CarreauYasuda& law, double shear_rate, double /*hematocrit*/) {
  return law.mu_inf + (law.mu0 - law.mu_inf) * bend(law, law.time * shear_rate).factor;
}

double logarithmic_slope(const CarreauYasuda& law, double shear_rate, double hematocrit) {
  const Bend b = bend(law, law.time * shear_rate);
  return (law.mu0 - law.mu_inf) * b.factor * (law.power - 1) * b.weight /
         viscosity(law, shear_rate, hematocrit);
}

}  // namespace hemoscale::macro
