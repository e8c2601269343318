#include "macro/viscosity/newtonian.hpp"

#include "macro/parameter_check.hpp"

namespace hemoscale::macro {

void check(const Newtonian& law) {
  require_positive({"Newtonian law", "mu", law.mu, "Pa s"}, "give the dynamic viscosity in Pa s");
}

double viscosity(const Newtonian& law, double /*shear_rate*/, double /*hematocrit*/) {
  return law.mu;
}

double logarithmic_slope(const Newtonian& /*law*/, double /*shear_rate*/, double /*hematocrit*/) {
  return 0;
}

}  // namespace hemoscale::macro
