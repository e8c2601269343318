#pragma once

#include <vector>

#include "macro/viscosity/viscosity_law.hpp"

namespace hemoscale::macro {

/// Shear rates at which the law, as a function of log(shear rate), is not smooth: where a value
/// begins to be held, and the knots of a table (of all its rows). Between them the law is analytic,
/// so that a quadrature that starts new panels there keeps its order.
///
/// @returns  [1/s] strictly increasing, possibly empty
std::vector<double> kinks(const ViscosityLaw& law);

}  // namespace hemoscale::macro
