#pragma once

#include <limits>
#include <span>
#include <vector>

namespace hemoscale::coupling {

/// How fast an error falls along a refinement axis h.
struct OrderFit {
  double order = std::numeric_limits<double>::quiet_NaN();           // [-]
  double standard_error = std::numeric_limits<double>::quiet_NaN();  // [-] from three points on
  std::vector<double> pairwise;  // [-] between neighbours that count
  int points = 0;                // [-] that count
};

/// Observed order p of error = C h^p: the slope of the least-squares line through (ln h, ln error),
///
///   p = sum (x - x_mean)(y - y_mean) / S,  S = sum (x - x_mean)^2,
///   standard error = sqrt( sum residual^2 / ((n - 2) S) ),
///
/// with the sign reversed where h grows along the axis (a number of nodes, say), so that an error
/// that falls has a positive order. Points count whose h and error are finite and above zero; with
/// fewer than two different h there is no order (nan).
///
/// @param refinements  h, in the order of the axis
OrderFit fit_order(std::span<const double> refinements, std::span<const double> errors);

}  // namespace hemoscale::coupling
