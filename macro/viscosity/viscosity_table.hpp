#pragma once

#include <vector>

namespace hemoscale::macro {

/// One row of a viscosity table: viscosity against shear rate at one hematocrit.
struct ViscosityRow {
  double hematocrit = 0;            // [-]
  std::vector<double> shear_rates;  // [1/s] positive, strictly increasing, at least one
  std::vector<double> viscosities;  // [Pa s] positive, as many as shear_rates
};

/// Viscosity from a table: monotone cubic Hermite interpolation (Fritsch and Carlson 1980) of
/// log(viscosity) against log(shear rate) along a row, linear in hematocrit between the logarithms
/// of two rows. Monotone between two knots; a row with one knot is constant. Outside the knots of
/// a row, and outside the rows, the nearest value is held: the caller who cares asks in_range().
class ViscosityTable {
 public:
  /// @throws ParameterError naming the first bad entry (empty, not positive, not increasing)
  explicit ViscosityTable(std::vector<ViscosityRow> rows);

  double viscosity(double shear_rate, double hematocrit) const;  // [Pa s]
  bool in_range(double shear_rate, double hematocrit) const;
  const std::vector<ViscosityRow>& rows() const { return rows_; }

 private:
  std::vector<ViscosityRow> rows_;            // sorted by hematocrit
  std::vector<std::vector<double>> slopes_;   // d log(mu) / d log(shear rate) at the knots [-]
};

inline double viscosity(const ViscosityTable& law, double shear_rate, double hematocrit) {
  return law.viscosity(shear_rate, hematocrit);
}

}  // namespace hemoscale::macro
