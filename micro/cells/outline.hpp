#pragma once

#include <vector>

#include "micro/vector.hpp"

namespace hemoscale::micro {

enum class Outline {
  evans_fung,  // section of the biconcave red cell [Evans and Fung 1972]
  ellipse,
  deflated  // circle deflated at constant perimeter [Tsubota2006, section 3.1]
};

struct OutlineParameters {
  Outline outline = Outline::evans_fung;
  double length = 7.82e-6;     // [m] largest extent
  double aspect = 0.35;        // [-] thickness over length; ellipse only, (0, 1]
  double reduced_area = 0.30;  // [-] of the deflated outline: area over that of the circle of its
                               // perimeter, (0.27, 1]
};

/// Nodes on the outline of a cell, counter-clockwise, equally spaced in arc length, the first on
/// the positive first axis; centred on the origin with the long axis along the first axis.
///
/// Evans and Fung 1972:  z(r) = +-(R/2) sqrt(1 - s) (0.207161 + 2.002558 s - 1.122762 s^2),
/// s = r^2/R^2, R = length/2.
///
/// Its arc length is integrated numerically to a relative accuracy of about 1e-10.
///
/// Deflated: the shape of least bending energy at its area (see rest_shape.hpp), scaled to the
/// given length. The section of Evans and Fung has the reduced area 0.46; "a decrease in area by 70
/// % from a circular shape" is 0.30. Its segments are equal; takes a few milliseconds at 100 nodes.
///
/// @param nodes  at least 8
/// @returns positions [m]
/// @throws ParameterError
/// @throws NumericalError if no deflated shape is found
std::vector<Vector<2>> outline_nodes(const OutlineParameters& parameters, int nodes);

}  // namespace hemoscale::micro
