#pragma once

#include "micro/mps/stage_options.hpp"

namespace hemoscale::micro {

/// Next to the resting walls a uniform inlet of speed U carries less than U times the height: the
/// velocity falls to zero between the last inlet node and the wall. How much is lost, counted in
/// spacings, is a property of the operators at the corner: 0.9 spacings for a kernel ratio of 2.5,
/// 1.05 for 3.1, almost the same for any number n of spacings across. It is found from one Stokes
/// solve in a short channel.
///
/// @param rows  n, spacings between the walls
/// @returns the speed of the inlet nodes over the mean speed wanted, n / (n - lost spacings)
double uniform_inlet_factor(const StageOptions& options, double rows);

}  // namespace hemoscale::micro
