#pragma once

#include <string>
#include <variant>

#include "macro/viscosity/carreau_yasuda.hpp"
#include "macro/viscosity/casson.hpp"
#include "macro/viscosity/cross.hpp"
#include "macro/viscosity/newtonian.hpp"
#include "macro/viscosity/power_law.hpp"
#include "macro/viscosity/quemada.hpp"
#include "macro/viscosity/viscosity_table.hpp"

namespace hemoscale::macro {

/// Dynamic viscosity as a function of shear rate and hematocrit: an immutable value, and the only
/// thing that returns from the micro to the macro scale.
///
/// C++17-clean: the OpenFOAM viscosity model includes it.
class ViscosityLaw {
 public:
  using Model =
      std::variant<Newtonian, CarreauYasuda, Casson, Cross, PowerLaw, Quemada, ViscosityTable>;

  ViscosityLaw(Model model);  // NOLINT(google-explicit-constructor): every model is a law

  /// @param shear_rate  sqrt(2 D:D), not negative [1/s]
  /// @param hematocrit  volume fraction of red cells [-]
  /// @returns           dynamic viscosity [Pa s]
  double viscosity(double shear_rate, double hematocrit) const;

  /// d(log viscosity) / d(log shear rate); n - 1 for a power law of index n [-]
  double logarithmic_slope(double shear_rate, double hematocrit) const;

  const Model& model() const { return model_; }
  std::string name() const;

 private:
  Model model_;
};

}  // namespace hemoscale::macro
