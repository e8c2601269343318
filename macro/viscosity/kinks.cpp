#include "macro/viscosity/kinks.hpp"

#include <algorithm>

namespace hemoscale::macro {

namespace {

struct Kinks {
  std::vector<double> operator()(const Newtonian&) const { return {}; }
  std::vector<double> operator()(const CarreauYasuda&) const { return {}; }
  std::vector<double> operator()(const Casson& law) const { return {law.lowest_shear_rate}; }
  std::vector<double> operator()(const Cross&) const { return {}; }
  std::vector<double> operator()(const PowerLaw& law) const {
    return {law.lowest_shear_rate, law.highest_shear_rate};
  }
  std::vector<double> operator()(const Quemada&) const { return {}; }
  std::vector<double> operator()(const ViscosityTable& law) const {
    std::vector<double> knots;
    for (const ViscosityRow& row : law.rows()) {
      knots.insert(knots.end(), row.shear_rates.begin(), row.shear_rates.end());
    }
    return knots;
  }
};

}  // namespace

std::vector<double> kinks(const ViscosityLaw& law) {
  std::vector<double> rates = std::visit(Kinks{}, law.model());
  std::sort(rates.begin(), rates.end());
  rates.erase(std::unique(rates.begin(), rates.end()), rates.end());
  return rates;
}

}  // namespace hemoscale::macro
