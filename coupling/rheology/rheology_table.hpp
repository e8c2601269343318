#pragma once

#include <vector>

#include "coupling/rheology/rheology_sample.hpp"
#include "macro/viscosity/viscosity_law.hpp"

namespace hemoscale::coupling {

/// Bounds that a fitted law must respect; physical knowledge, not repair: every knot that a bound
/// moves is counted and reported.
struct FitBounds {
  double lowest_viscosity = 0;   // [Pa s] e.g. that of plasma
  double highest_viscosity = 0;  // [Pa s]
  bool shear_thinning = true;    // viscosity does not increase with shear rate
};

/// Samples made into a viscosity law, with the range and the error within which to trust it.
///
/// Samples at (nearly) the same shear rate and hematocrit are pooled with weights 1/error^2. The
/// monotone fit is the weighted least-squares fit of log(viscosity) under the order constraint
/// (pool-adjacent-violators; Barlow, Bartholomew, Bremner and Brunk 1972), then a ViscosityTable.
class RheologyTable {
 public:
  /// @throws CaseError-free std::invalid_argument on an empty list or a value that is not positive
  RheologyTable(std::vector<RheologySample> samples, const FitBounds& bounds);

  const macro::ViscosityLaw& law() const { return law_; }
  const std::vector<RheologySample>& samples() const { return samples_; }

  /// Half-width of the simultaneous 95 % confidence band of log(viscosity) at a shear rate and a
  /// hematocrit inside the trusted range: over all shear rates at once, not one at a time [-].
  double log_half_width(double shear_rate, double hematocrit) const;

  bool is_trusted(double shear_rate, double hematocrit) const;

  int knots_moved_by_bounds() const { return knots_moved_by_bounds_; }
  int knots_pooled_by_monotonicity() const { return knots_pooled_by_monotonicity_; }

 private:
  std::vector<RheologySample> samples_;
  macro::ViscosityLaw law_;
  std::vector<std::vector<double>> log_half_widths_;  // [-] per row and knot of the table
  int knots_moved_by_bounds_ = 0;
  int knots_pooled_by_monotonicity_ = 0;
};

}  // namespace hemoscale::coupling
