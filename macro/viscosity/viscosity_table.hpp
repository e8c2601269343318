#pragma once

#include <cstddef>
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
///
/// Along a row the logarithm is continuous with its first derivative, third-order accurate for
/// smooth monotone data, and exact for a power law.
class ViscosityTable {
 public:
  /// @param rows  strictly increasing in hematocrit, which lies in [0, 1)
  /// @throws ParameterError naming the first bad entry (empty, not positive, not increasing)
  explicit ViscosityTable(std::vector<ViscosityRow> rows);

  double viscosity(double shear_rate, double hematocrit) const;  // [Pa s]

  /// d(log viscosity) / d(log shear rate), zero where the value is held [-]
  double logarithmic_slope(double shear_rate, double hematocrit) const;

  /// Whether nothing is held: the hematocrit lies between the rows (or on one), and the shear rate
  /// between the knots of each row that takes part.
  bool in_range(double shear_rate, double hematocrit) const;

  const std::vector<ViscosityRow>& rows() const { return rows_; }

 private:
  struct Knots {
    std::vector<double> x;       // log(shear rate / (1/s))
    std::vector<double> y;       // log(viscosity / (Pa s))
    std::vector<double> slopes;  // d log(mu) / d log(shear rate) at the knots [-]
  };
  struct Blend {
    std::size_t lower = 0;  // rows that take part
    std::size_t upper = 0;
    double weight = 0;  // of the upper row [-]
  };
  struct Value {
    double y = 0;      // log(viscosity / (Pa s))
    double slope = 0;  // [-]
  };

  Blend blend(double hematocrit) const;
  static Value along_row(const Knots& knots, double shear_rate);
  Value between_rows(double shear_rate, double hematocrit) const;

  std::vector<ViscosityRow> rows_;  // sorted by hematocrit
  std::vector<Knots> knots_;        // one for each row
};

/// The constructor has checked: nothing to do.
inline void check(const ViscosityTable& /*law*/) {}

inline double viscosity(const ViscosityTable& law, double shear_rate, double hematocrit) {
  return law.viscosity(shear_rate, hematocrit);
}

inline double logarithmic_slope(const ViscosityTable& law, double shear_rate, double hematocrit) {
  return law.logarithmic_slope(shear_rate, hematocrit);
}

}  // namespace hemoscale::macro
