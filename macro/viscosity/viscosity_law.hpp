#pragma once

#include <string>
#include <type_traits>
#include <utility>
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
  template <typename One, typename Variant>
  struct IsAlternative : std::false_type {};
  template <typename One, typename... All>
  struct IsAlternative<One, std::variant<All...>> : std::disjunction<std::is_same<One, All>...> {};

 public:
  using Model =
      std::variant<Newtonian, CarreauYasuda, Casson, Cross, PowerLaw, Quemada, ViscosityTable>;

  /// @throws ParameterError naming the first parameter that is not admissible
  ViscosityLaw(Model model);  // NOLINT(google-explicit-constructor): every model is a law

  /// The same from one of the models, so that `ViscosityLaw law = Newtonian{1.2e-3}` is one step.
  template <typename One,
            typename = std::enable_if_t<IsAlternative<std::decay_t<One>, Model>::value>>
  ViscosityLaw(One&& model)  // NOLINT(google-explicit-constructor)
      : ViscosityLaw(Model(std::forward<One>(model))) {}

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
