#pragma once

#include <vector>

#include "macro/viscosity/viscosity_table.hpp"

namespace hemoscale::coupling {

/// Weights of the knots of a table in norms over log(shear rate): half the distance to the
/// neighbours in log(shear rate) along each row, scaled so that all weights of a row sum to one. A
/// cluster of knots then counts as much as one knot in its place. In the order rows, knots.
std::vector<double> knot_weights(const std::vector<macro::ViscosityRow>& rows);

/// sqrt(sum w x^2 / sum w)
double weighted_rms(const std::vector<double>& values, const std::vector<double>& weights);

/// When an iteration counts as diverging: the change rose in so many passes in a row, by so much in
/// all, and is not small; or it is huge.
struct DivergenceLimits {
  int rising_passes = 5;         // [-] in a row
  double growth = 2;             // [-] over those passes
  double smallest_change = 0.1;  // [-] rms change of log viscosity; below it nothing diverges
  double largest_change = 50;    // [-] rms change of log viscosity; above it everything does
};

/// @param changes  of all passes so far, oldest first, in one window or over the run
/// @throws NumericalError with pass, change and remedy if the last change is not finite or the
///         limits are met
void require_no_divergence(const std::vector<double>& changes, const DivergenceLimits& limits,
                           double relaxation_factor);

}  // namespace hemoscale::coupling
