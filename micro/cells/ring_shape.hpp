#pragma once

#include "micro/cells/ring_curve.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// What is seen of the outline of one cell; the flow is along x.
///
/// All are figures of the curve through the nodes (see RingCurve) and have an error of fourth order
/// in their spacing. The area that a membrane law keeps is that of the polygon, which is smaller by
/// about (spacing * curvature)^2 / 6 of it: see RingStrain for errors against the rest shape.
struct RingShape {
  double area = 0;                         // [m^2] enclosed; negative for a clockwise ring
  double perimeter = 0;                    // [m]
  double reduced_area = 0;                 // [-] 4 pi A / P^2
  Vector<2> centroid = Vector<2>::Zero();  // [m] of the area
  Vector<2> lower = Vector<2>::Zero();     // [m] corner of the box around the cell
  Vector<2> upper = Vector<2>::Zero();     // [m]
  double length = 0;                       // [m] extent along the flow
  double width = 0;                        // [m] extent across it

  // Of the ellipse with the same area moments about the centroid, M_ij = int X_i X_j dA, whose
  // semi-axes are in the ratio of the roots of their principal values.
  double inclination = 0;   // [rad] of the long axis against x, in (-pi/2, pi/2]; a cell without a
                            // long axis has 0
  double deformation = 0;   // [-] (L - B)/(L + B) of its axes
  double axial_length = 0;  // [m] extent of the cell along its long axis
  double axial_width = 0;   // [m] and across it
};

/// @throws ParameterError for a curve without area
RingShape measure_shape(const RingCurve& curve);

/// Second moments of area about the centroid, int X_i X_j dA [m^4].
Tensor<2> area_moments(const RingCurve& curve, const Vector<2>& centroid);

/// The curve's reach along a unit vector: the smallest and the largest of r . direction [m].
struct Reach {
  double smallest = 0;
  double largest = 0;
};
Reach reach_along(const RingCurve& curve, const Vector<2>& direction);

}  // namespace hemoscale::micro
