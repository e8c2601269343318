#pragma once

#include <vector>

#include "micro/ensemble/blocks/kernel_arguments.hpp"

namespace hemoscale::micro::blocks {

/// Stages of a Runge-Kutta-Chebyshev step of second order [Sommeijer, Shampine and Verwer 1997]
/// with the damping 2/13. With the Chebyshev polynomials T_j at w0 = 1 + 2/(13 s^2):
///
///   w1 = T_s'/T_s'',   b_j = T_j''/(T_j')^2,   b_0 = b_1 = b_2,   a_j = 1 - b_j T_j
///   before_j = 2 b_j w0/b_(j-1),   second_j = -b_j/b_(j-2),   base_j = 1 - before_j - second_j
///   force_j = 2 b_j w1/b_(j-1),   first_force_j = -a_(j-1) force_j,   force_1 = b_1 w1
///
/// @pre stages >= 2
std::vector<StageWeights<double>> chebyshev_weights(int stages);

/// Largest dt lambda of a stable step, (w0 + 1)/w1, about 0.65 s^2. [-]
double chebyshev_reach(int stages);

}  // namespace hemoscale::micro::blocks
