#pragma once

#include <limits>
#include <variant>
#include <vector>

#include "coupling/error.hpp"

namespace hemoscale::coupling {

/// x(n+1) = x(n) + factor r(n), the residual r being candidate minus x.
struct ConstantRelaxation {
  double factor = 1;  // [-] in (0, 2]
};

/// The factor is found from the last two residuals by Aitken's delta-squared process in its vector
/// form (Irons and Tuck 1969, Int. J. Numer. Meth. Eng. 1, 275; Kuettler and Wall 2008, Comput.
/// Mech. 43, 61, eq. 44):
///
///   factor(n+1) = - factor(n) r(n).(r(n+1) - r(n)) / |r(n+1) - r(n)|^2
///
/// Exact after two residuals if there is one unknown and the map is linear. If the residual did not
/// change the factor stays. Factors outside the bounds are moved to them and counted.
struct AitkenRelaxation {
  double initial_factor = 1;                                        // [-] in (0, 2]
  double lowest_factor = -std::numeric_limits<double>::infinity();  // [-]
  double highest_factor = std::numeric_limits<double>::infinity();  // [-]
};

using Relaxation = std::variant<ConstantRelaxation, AitkenRelaxation>;

/// What is out of range, with the keys coupling.relaxation_factor or coupling.relaxation.
std::vector<Fault> faults_of(const Relaxation& relaxation);

/// The factor before there is a history.
double initial_factor(const Relaxation& relaxation);

struct FactorChoice {
  double factor = 1;     // [-]
  bool bounded = false;  // a bound moved it
};

/// The factor for the newest residual.
///
/// @param previous_factor    that was used with previous_residual
/// @param previous_residual  candidate minus unknown, one pass ago, at the same knots
/// @param residual           the newest one
/// @param weights            of the knots in the inner product, positive; all of one length
FactorChoice next_factor(const Relaxation& relaxation, double previous_factor,
                         const std::vector<double>& previous_residual,
                         const std::vector<double>& residual, const std::vector<double>& weights);

}  // namespace hemoscale::coupling
