#pragma once

#include <vector>

#include "micro/vector.hpp"

namespace hemoscale::micro {

enum class Outline {
  evans_fung,  // section of the biconcave red cell [Evans and Fung 1972]
  ellipse
};

struct OutlineParameters {
  Outline outline = Outline::evans_fung;
  double length = 7.82e-6;  // [m] largest extent
  double aspect = 0.35;     // [-] thickness over length; ellipse only, (0, 1]
};

/// Nodes on the outline of a cell, counter-clockwise, equally spaced in arc length, the first on
/// the positive first axis; centred on the origin with the long axis along the first axis.
///
/// Evans and Fung 1972:  z(r) = +-(R/2) sqrt(1 - s) (0.207161 + 2.002558 s - 1.122762 s^2),
/// s = r^2/R^2, R = length/2.
///
/// The arc length is integrated numerically to a relative accuracy of about 1e-10.
///
/// @param nodes  at least 8
/// @returns positions [m]
/// @throws ParameterError
std::vector<Vector<2>> outline_nodes(const OutlineParameters& parameters, int nodes);

}  // namespace hemoscale::micro
