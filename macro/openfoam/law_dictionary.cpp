#include "macro/openfoam/law_dictionary.hpp"

#include <cmath>
#include <exception>
#include <initializer_list>
#include <string>

#include "stringOps.H"

namespace hemoscale::macro {
namespace {

using Foam::FatalIOError;  // for the macro below
using Foam::IOerror;

[[noreturn]] void refuse(const Foam::dictionary& dictionary, const std::string& message) {
  FatalIOErrorInFunction(dictionary) << message.c_str() << Foam::exit(FatalIOError);
  std::terminate();  // exit() does not return
}

/// One table of the dictionary, which may be absent: every value of it then has its default.
class Table {
 public:
  Table(const Foam::dictionary& parent, const char* name)
      : parent_(parent), found_(parent.findDict(name)) {}

  double positive(const char* key, double fallback) const {
    const double value = number(key, fallback);
    if (!(value > 0)) refuse_value(key, value, "must be positive");
    return value;
  }
  double not_negative(const char* key, double fallback) const {
    const double value = number(key, fallback);
    if (!(value >= 0)) refuse_value(key, value, "must not be negative");
    return value;
  }
  void allow_only(std::initializer_list<const char*> keys) const {
    if (found_ == nullptr) return;
    for (const Foam::entry& entry : *found_) {
      std::string known;
      bool is_known = false;
      for (const char* key : keys) {
        is_known = is_known || entry.keyword() == key;
        known += std::string(known.empty() ? "" : " ") + key;
      }
      if (!is_known) {
        refuse(*found_, "line " + std::to_string(entry.startLineNumber()) + ": unknown entry '" +
                            entry.keyword() + "'; known here: " + known);
      }
    }
  }

 private:
  double number(const char* key, double fallback) const {
    Foam::scalar value = fallback;
    if (found_ != nullptr) found_->readIfPresent(key, value);
    if (!std::isfinite(value)) refuse_value(key, value, "must be finite");
    return value;
  }
  [[noreturn]] void refuse_value(const char* key, double value, const char* rule) const {
    refuse(found_ != nullptr ? *found_ : parent_,
           std::string(key) + " is " + std::to_string(value) + "; it " + rule + " (SI)");
  }

  const Foam::dictionary& parent_;
  const Foam::dictionary* found_;
};

ViscosityLaw read_law(const Foam::dictionary& laws, double plasma_viscosity) {
  const Foam::word initial = laws.get<Foam::word>("initial");
  if (initial == "newtonian") {
    const Table t(laws, "newtonian");
    t.allow_only({"viscosity"});
    return ViscosityLaw(Newtonian{t.positive("viscosity", 3.5e-3)});
  }
  if (initial == "carreau-yasuda") {
    const Table t(laws, "carreau_yasuda");
    t.allow_only({"zero_viscosity", "infinite_viscosity", "time", "power", "transition"});
    const CarreauYasuda blood = cho_kensey_1991();
    CarreauYasuda law;
    law.mu0 = t.positive("zero_viscosity", blood.mu0);
    law.mu_inf = t.not_negative("infinite_viscosity", blood.mu_inf);
    law.time = t.positive("time", blood.time);
    law.power = t.not_negative("power", blood.power);
    law.transition = t.positive("transition", blood.transition);
    return ViscosityLaw(law);
  }
  if (initial == "casson") {
    const Table t(laws, "casson");
    t.allow_only({"yield_stress", "viscosity", "lowest_shear_rate"});
    return ViscosityLaw(Casson{t.not_negative("yield_stress", 5e-3),
                               t.positive("viscosity", 3.5e-3),
                               t.positive("lowest_shear_rate", 1e-3)});
  }
  if (initial == "cross") {
    const Table t(laws, "cross");
    t.allow_only({"zero_viscosity", "infinite_viscosity", "time", "power"});
    return ViscosityLaw(Cross{t.positive("zero_viscosity", 0),
                              t.not_negative("infinite_viscosity", 0), t.positive("time", 0),
                              t.positive("power", 0)});
  }
  if (initial == "power-law") {
    const Table t(laws, "power_law");
    t.allow_only({"consistency", "power", "lowest_shear_rate", "highest_shear_rate"});
    return ViscosityLaw(PowerLaw{t.positive("consistency", 0), t.positive("power", 0),
                                 t.positive("lowest_shear_rate", 0),
                                 t.positive("highest_shear_rate", 0)});
  }
  if (initial == "quemada") {
    const Table t(laws, "quemada");
    t.allow_only({"packing_low", "packing_high", "critical_shear_rate"});
    return ViscosityLaw(Quemada{plasma_viscosity, t.not_negative("packing_low", 4.33),
                                t.not_negative("packing_high", 2.07),
                                t.positive("critical_shear_rate", 1.88)});
  }
  refuse(laws, "initial is '" + initial +
                   "'; it must be newtonian, carreau-yasuda, casson, cross, power-law or quemada");
}

}  // namespace

InitialLaw read_initial_law(const Foam::dictionary& dictionary) {
  for (const Foam::entry& entry : dictionary) {
    const Foam::keyType& key = entry.keyword();
    if (key == "law" || key == "fluid" || key == "macro") continue;
    refuse(dictionary, "line " + std::to_string(entry.startLineNumber()) + ": unknown entry '" +
                           key + "'; known here: law fluid macro");
  }
  const Table fluid(dictionary, "fluid");
  fluid.allow_only({"plasma_viscosity", "density", "hematocrit"});
  MeshUnits units;
  units.density = fluid.positive("density", 1050);
  if (const Foam::dictionary* macro = dictionary.findDict("macro")) {
    const Table openfoam(*macro, "openfoam");
    openfoam.allow_only({"length_unit", "time_unit"});
    units.length = openfoam.positive("length_unit", 1);
    units.time = openfoam.positive("time_unit", 1);
  }
  const double hematocrit = dictionary.subDict("fluid").get<Foam::scalar>("hematocrit");
  try {
    ViscosityLaw law =
        read_law(dictionary.subDict("law"), fluid.positive("plasma_viscosity", 1.2e-3));
    law.viscosity(1, hematocrit);  // a hematocrit at which the law cannot be evaluated ends here
    return InitialLaw{std::move(law), hematocrit, units};
  } catch (const std::runtime_error& error) {
    refuse(dictionary, error.what());
  }
}

}  // namespace hemoscale::macro
