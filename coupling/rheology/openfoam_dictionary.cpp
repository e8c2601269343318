#include "coupling/rheology/openfoam_dictionary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace hemoscale::coupling {

std::string openfoam_dictionary(const macro::ViscosityLaw& law, double hematocrit, double density,
                                const DictionaryRange& range, const std::string& note) {
  if (!(range.lowest_shear_rate > 0 && range.highest_shear_rate > range.lowest_shear_rate &&
        range.points_per_decade >= 1 && density > 0)) {
    throw std::invalid_argument(fmt::format(
        "OpenFOAM dictionary: shear rates {} to {} 1/s, {} points per decade, density {} kg/m^3; "
        "all must be positive and the range must rise",
        range.lowest_shear_rate, range.highest_shear_rate, range.points_per_decade, density));
  }
  if (note.find('\n') != std::string::npos) {
    throw std::invalid_argument("OpenFOAM dictionary: the note must be one line");
  }
  const double decades = std::log10(range.highest_shear_rate / range.lowest_shear_rate);
  const int intervals = static_cast<int>(std::ceil(decades * range.points_per_decade));

  std::string text = fmt::format(
      "// {}\n"
      "// Kinematic viscosity [m^2/s] against shear rate [1/s]; hematocrit {}, density {} kg/m^3.\n"
      "// Tabulated from {} to {} 1/s; held outside.\n"
      "FoamFile\n{{\n    version     2.0;\n    format      ascii;\n    class       dictionary;\n"
      "    location    \"constant\";\n    object      transportProperties;\n}}\n\n"
      "transportModel  strainRateFunction;\n\n"
      "strainRateFunctionCoeffs\n{{\n    function table\n    (\n",
      note, hematocrit, density, range.lowest_shear_rate, range.highest_shear_rate);
  const auto row = [&](double written_rate, double rate) {
    text += fmt::format("        ({:.12g} {:.12g})\n", written_rate,
                        law.viscosity(rate, hematocrit) / density);
  };
  row(0, range.lowest_shear_rate);
  for (int i = 0; i <= intervals; ++i) {
    const double rate = i == intervals
                            ? range.highest_shear_rate
                            : range.lowest_shear_rate * std::pow(10.0, decades * i / intervals);
    row(rate, rate);
  }
  return text + "    );\n}\n";
}

}  // namespace hemoscale::coupling
