#include "coupling/scene/build_law.hpp"

#include <cassert>

#include "coupling/error.hpp"
#include "macro/error.hpp"

namespace hemoscale::coupling {

namespace {

macro::ViscosityLaw::Model make_law(const Settings& settings, const std::string& choice,
                                    const std::string& section) {
  const auto value = [&](const char* law, const char* name) {
    return settings.quantity(section + "." + law + "." + name);
  };
  if (choice == "newtonian") return macro::Newtonian{value("newtonian", "viscosity")};
  if (choice == "carreau-yasuda") {
    const char* law = "carreau_yasuda";
    return macro::CarreauYasuda{value(law, "zero_viscosity"), value(law, "infinite_viscosity"),
                                value(law, "time"), value(law, "power"), value(law, "transition")};
  }
  if (choice == "casson") {
    return macro::Casson{value("casson", "yield_stress"), value("casson", "viscosity"),
                         value("casson", "lowest_shear_rate")};
  }
  if (choice == "cross") {
    return macro::Cross{value("cross", "zero_viscosity"), value("cross", "infinite_viscosity"),
                        value("cross", "time"), value("cross", "power")};
  }
  if (choice == "power-law") {
    const char* law = "power_law";
    return macro::PowerLaw{value(law, "consistency"), value(law, "power"),
                           value(law, "lowest_shear_rate"), value(law, "highest_shear_rate")};
  }
  assert(choice == "quemada");
  return macro::Quemada{settings.quantity("fluid.plasma_viscosity"),
                        value("quemada", "packing_low"), value("quemada", "packing_high"),
                        value("quemada", "critical_shear_rate")};
}

}  // namespace

macro::ViscosityLaw build_law(const Settings& settings, const std::string& choice_key,
                              const std::string& section) {
  try {
    return make_law(settings, settings.text(choice_key), section);
  } catch (const macro::ParameterError& error) {
    const Location place = settings.location(choice_key);
    throw CaseError({{place.file, place.line, place.column, choice_key, error.what()}});
  }
}

}  // namespace hemoscale::coupling
