#pragma once

#include <span>

#include "micro/observation.hpp"

namespace hemoscale::micro {

/// Mean and standard error of a correlated, stationary, equally spaced series.
///
///   tau = 1/2 + sum_{k=1}^{M} rho_k   [samples],   standard error = s sqrt(2 tau / n),
///
/// with the window M closed at the first M >= 5 tau(M) [Sokal 1997, section 3], and the first-order
/// correction of rho for the mean being taken from the same data (factor 1 + (2 M + 1)/n) [Wolff
/// 2004, eq. 49]. `effective_samples` is n / (2 tau). The error is trustworthy from some 50
/// effective samples on; below, it is too small on average.
///
/// A series without any scatter has standard error 0. One sample has an infinite standard error.
///
/// @param series   samples, at least one
/// @param spacing  time between samples [s]
Estimate estimate_mean(std::span<const double> series, double spacing);

/// Standard error from the scatter of `blocks` block averages; samples that do not fill the last
/// block are left out. Independent check of estimate_mean: valid for blocks much longer than the
/// correlation time.
/// @throws ParameterError for fewer than two blocks, or more blocks than samples
double block_standard_error(std::span<const double> series, int blocks);

}  // namespace hemoscale::micro
