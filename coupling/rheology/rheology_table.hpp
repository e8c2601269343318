#pragma once

#include <vector>

#include "coupling/rheology/rheology_sample.hpp"
#include "macro/viscosity/viscosity_law.hpp"

namespace hemoscale::coupling {

/// Bounds that a fitted law must respect; physical knowledge, not repair: every knot that a bound
/// moves is counted and reported.
struct FitBounds {
  double lowest_viscosity = 0;    // [Pa s] not negative; e.g. that of plasma
  double highest_viscosity = 0;   // [Pa s] above the lowest one
  bool shear_thinning = true;     // viscosity does not increase with shear rate
  double steepest_slope = -0.99;  // [-] of log(viscosity) against log(shear rate), above -1; at -1
                                  // the shear stress stops to rise and there is no stable flow
};

/// How close samples must be to be pooled into one knot of the table.
struct Pooling {
  double shear_ratio = 1.02;  // [-] at least 1: highest over lowest shear rate of a knot's samples
  double hematocrit = 1e-3;   // [-] not negative: width of a row in hematocrit
};

/// Samples made into a viscosity law, with the range and the error within which to trust it.
///
/// Samples at (nearly) the same shear rate and hematocrit are pooled with weights 1/error^2. The
/// monotone fit is the weighted least-squares fit of log(viscosity) under the order constraint
/// (pool-adjacent-violators; Barlow, Bartholomew, Bremner and Brunk 1972), then a ViscosityTable.
/// Neighbouring knots between which noise makes the law fall more steeply than allowed are merged
/// into one and counted. The README of this folder derives the confidence band and its limits.
class RheologyTable {
 public:
  /// @throws std::invalid_argument on an empty list, a value of a sample that is not positive (an
  ///         error or hematocrit that is negative), samples of different dimension, or bounds or
  ///         pooling out of range
  RheologyTable(std::vector<RheologySample> samples, const FitBounds& bounds,
                const Pooling& pooling = {});

  const macro::ViscosityLaw& law() const { return law_; }
  const std::vector<RheologySample>& samples() const { return samples_; }

  /// The rows of the law: one for each hematocrit.
  const std::vector<macro::ViscosityRow>& rows() const { return rows_; }

  /// Standard errors of log(viscosity) at the knots of the rows, before the monotone fit [-].
  const std::vector<std::vector<double>>& log_errors() const { return log_errors_; }

  /// Half-width of the simultaneous 95 % confidence band of log(viscosity) at a shear rate and a
  /// hematocrit inside the trusted range: over all shear rates and hematocrits at once, not one at
  /// a time [-]. Infinite outside the trusted range, and where a sample holds too little for any
  /// statement.
  double log_half_width(double shear_rate, double hematocrit) const;

  /// Whether samples surround the point: both rows next to the hematocrit (the row itself, within
  /// the width of pooling) have knots on both sides of the shear rate, or at it.
  bool is_trusted(double shear_rate, double hematocrit) const;

  int knots_moved_by_bounds() const { return knots_moved_by_bounds_; }
  int knots_pooled_by_monotonicity() const { return knots_pooled_by_monotonicity_; }
  int knots_merged_for_rising_stress() const { return knots_merged_for_rising_stress_; }

 private:
  struct Fit;
  static Fit fit(const std::vector<RheologySample>& samples, const FitBounds& bounds,
                 const Pooling& pooling);
  RheologyTable(std::vector<RheologySample> samples, const Pooling& pooling, Fit fit);

  std::vector<RheologySample> samples_;
  Pooling pooling_;
  std::vector<macro::ViscosityRow> rows_;
  std::vector<std::vector<double>> log_errors_;       // [-] per row and knot
  std::vector<std::vector<double>> log_half_widths_;  // [-] per row and knot
  macro::ViscosityLaw law_;
  int knots_moved_by_bounds_ = 0;
  int knots_pooled_by_monotonicity_ = 0;
  int knots_merged_for_rising_stress_ = 0;
};

/// Degrees of freedom behind the standard error of a sample [-]; see the README of this folder.
double degrees_of_freedom(const RheologySample& sample);

}  // namespace hemoscale::coupling
