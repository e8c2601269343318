#include "micro/cells/capillary_number.hpp"

#include <fmt/format.h>

#include <cmath>

#include "micro/error.hpp"

namespace hemoscale::micro {

namespace {

void require_admissible(const CellInFlow& cell) {
  std::string faults;
  const auto require = [&faults](bool is_admissible, const char* name, double value,
                                 const char* unit, const char* range) {
    if (is_admissible) return;
    faults += fmt::format("{}{} is {} {}; admissible is {}", faults.empty() ? "" : "; ", name,
                          value, unit, range);
  };
  const auto is_positive = [](double value) { return value > 0 && std::isfinite(value); };
  require(is_positive(cell.viscosity), "viscosity", cell.viscosity, "Pa s", "above 0");
  require(cell.density >= 0 && std::isfinite(cell.density), "density", cell.density, "kg/m^3",
          "0 or more");
  require(cell.speed >= 0 && std::isfinite(cell.speed), "speed", cell.speed, "m/s", "0 or more");
  require(is_positive(cell.radius), "radius", cell.radius, "m", "above 0");
  require(cell.gap_width > 0, "gap width", cell.gap_width, "m", "above 0, or infinite");
  require(cell.stretch_modulus > 0, "stretch modulus", cell.stretch_modulus, "N/m",
          "above 0, or infinite");
  require(is_positive(cell.bending_modulus), "bending modulus", cell.bending_modulus, "J",
          "above 0");
  if (!faults.empty()) throw ParameterError(faults);
}

}  // namespace

CellNumbers cell_numbers(const CellInFlow& cell) {
  require_admissible(cell);
  const double size = std::isfinite(cell.gap_width) ? cell.gap_width : 2 * cell.radius;
  const double traction = cell.viscosity * cell.speed;
  return {.bending_capillary = traction * cell.radius * cell.radius / cell.bending_modulus,
          .stretch_capillary = traction / cell.stretch_modulus,
          .confinement = 2 * cell.radius / cell.gap_width,
          .reynolds = cell.density * cell.speed * size / cell.viscosity};
}

std::string unbounded_stretch(const CellInFlow& cell) {
  const double number = cell_numbers(cell).stretch_capillary;
  if (number < largest_stretch_capillary) return {};
  return fmt::format(
      "capillary number of stretching mu U / E_l = {:.3g}, not below {}: the membrane stretches "
      "without bound and its shape has no meaning (viscosity {:.3g} Pa s, speed {:.3g} m/s, "
      "stretch "
      "modulus {:.3g} N/m); reduce the speed below {:.3g} m/s or raise the modulus above {:.3g} "
      "N/m",
      number, largest_stretch_capillary, cell.viscosity, cell.speed, cell.stretch_modulus,
      largest_stretch_capillary * cell.stretch_modulus / cell.viscosity,
      cell.viscosity * cell.speed / largest_stretch_capillary);
}

}  // namespace hemoscale::micro
