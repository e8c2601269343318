#pragma once

#include <vector>

namespace hemoscale::macro {

/// Slopes at the knots that make the cubic Hermite interpolant monotone wherever the data are
/// (Fritsch and Carlson 1980, SIAM J. Numer. Anal. 17, 238).
///
/// Start: derivative of the parabola through a knot and its neighbours (one-sided at the ends), so
/// that smooth data are interpolated to third order. Then, interval by interval, slopes against the
/// direction of the data become zero, and a pair outside the circle alpha^2 + beta^2 <= 9, their
/// region S_2 (alpha, beta: slopes over secant), is scaled back onto it.
///
/// @param x  strictly increasing, at least one
/// @param y  as many as x
/// @returns  dy/dx at the knots; zero for a single knot
std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace hemoscale::macro
