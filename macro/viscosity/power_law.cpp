#include "macro/viscosity/power_law.hpp"

#include <algorithm>
#include <cmath>

#include "macro/parameter_check.hpp"

namespace hemoscale::macro {

void check(const PowerLaw& law) {
  const char* owner = "power law";
  require_positive({owner, "consistency", law.consistency, "Pa s^n"},
                   "give the viscosity at a shear rate of 1 1/s");
  require_positive({owner, "power", law.power, "-"},
                   "use less than 1 for shear thinning, 1 for a Newtonian fluid");
  require_positive({owner, "lowest_shear_rate", law.lowest_shear_rate, "1/s"},
                   "give the shear rate below which the viscosity is held");
  require(std::isfinite(law.highest_shear_rate) && law.highest_shear_rate > law.lowest_shear_rate,
          {owner, "highest_shear_rate", law.highest_shear_rate, "1/s"},
          "finite and above lowest_shear_rate = " + as_text(law.lowest_shear_rate) + " 1/s",
          "give the shear rate above which the viscosity is held");
}

double viscosity(const PowerLaw& law, double shear_rate, double /*hematocrit*/) {
  const double held = std::clamp(shear_rate, law.lowest_shear_rate, law.highest_shear_rate);
  return law.consistency * std::pow(held, law.power - 1);
}

double logarithmic_slope(const PowerLaw& law, double shear_rate, double /*hematocrit*/) {
  const bool held = shear_rate < law.lowest_shear_rate || shear_rate > law.highest_shear_rate;
  return held ? 0 : law.power - 1;
}

}  // namespace hemoscale::macro
