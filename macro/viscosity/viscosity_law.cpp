#include "macro/viscosity/viscosity_law.hpp"

#include <cassert>
#include <utility>

namespace hemoscale::macro {

namespace {

struct Name {
  const char* operator()(const Newtonian&) const { return "newtonian"; }
  const char* operator()(const CarreauYasuda&) const { return "carreau_yasuda"; }
  const char* operator()(const Casson&) const { return "casson"; }
  const char* operator()(const Cross&) const { return "cross"; }
  const char* operator()(const PowerLaw&) const { return "power_law"; }
  const char* operator()(const Quemada&) const { return "quemada"; }
  const char* operator()(const ViscosityTable&) const { return "table"; }
};

}  // namespace

ViscosityLaw::ViscosityLaw(Model model) : model_(std::move(model)) {
  std::visit([](const auto& law) { check(law); }, model_);
}

double ViscosityLaw::viscosity(double shear_rate, double hematocrit) const {
  assert(!(shear_rate < 0) && "a shear rate is a norm: not negative");
  return std::visit([&](const auto& law) { return macro::viscosity(law, shear_rate, hematocrit); },
                    model_);
}

double ViscosityLaw::logarithmic_slope(double shear_rate, double hematocrit) const {
  assert(!(shear_rate < 0) && "a shear rate is a norm: not negative");
  return std::visit(
      [&](const auto& law) { return macro::logarithmic_slope(law, shear_rate, hematocrit); },
      model_);
}

std::string ViscosityLaw::name() const {
  return std::visit(Name{}, model_);
}

}  // namespace hemoscale::macro
