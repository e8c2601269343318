#include "macro/viscosity/casson.hpp"

#include <algorithm>
#include <cmath>

#include "macro/parameter_check.hpp"

namespace hemoscale::macro {

void check(const Casson& law) {
  const char* owner = "Casson law";
  require_not_negative({owner, "yield_stress", law.yield_stress, "Pa"},
                       "use 0 for a fluid without yield stress");
  require_positive({owner, "mu_inf", law.mu_inf, "Pa s"},
                   "give the viscosity at infinite shear rate");
  require_positive({owner, "lowest_shear_rate", law.lowest_shear_rate, "1/s"},
                   "give a shear rate far below those of the flow, e.g. 1e-3 1/s");
}

double viscosity(const Casson& law, double shear_rate, double /*hematocrit*/) {
  const double held = std::max(shear_rate, law.lowest_shear_rate);
  const double root = std::sqrt(law.yield_stress / held) + std::sqrt(law.mu_inf);
  return root * root;
}

double logarithmic_slope(const Casson& law, double shear_rate, double /*hematocrit*/) {
  if (shear_rate < law.lowest_shear_rate) return 0;
  const double yield = std::sqrt(law.yield_stress / shear_rate);
  return -yield / (yield + std::sqrt(law.mu_inf));
}

}  // namespace hemoscale::macro
