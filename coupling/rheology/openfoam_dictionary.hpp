#pragma once

#include <string>

#include "macro/viscosity/viscosity_law.hpp"

namespace hemoscale::coupling {

/// Where and how finely a law is written out.
struct DictionaryRange {
  double lowest_shear_rate = 0;   // [1/s] positive
  double highest_shear_rate = 0;  // [1/s] above the lowest one
  int points_per_decade = 50;     // [-]
};

/// The law as text of a stock OpenFOAM `transportProperties` file: transport model
/// strainRateFunction with a table of the kinematic viscosity nu = mu / rho [m^2/s] against
/// sqrt(2) mag(symm(grad U)) [1/s]. OpenFOAM interpolates linearly and holds the ends; the law is
/// tabulated finely enough for that, and its value at the lowest shear rate repeated at zero.
///
/// @param hematocrit  [-] at which the law is taken: the dictionary knows one
/// @param density     [kg/m^3] of blood
/// @param note        one line for the header: origin, dimension of the micro model
/// @throws std::invalid_argument if the range or the density is not positive
std::string openfoam_dictionary(const macro::ViscosityLaw& law, double hematocrit, double density,
                                const DictionaryRange& range, const std::string& note);

}  // namespace hemoscale::coupling
