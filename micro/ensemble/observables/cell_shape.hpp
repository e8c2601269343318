#pragma once

#include <cstddef>
#include <vector>

#include "micro/ensemble/state.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// What is seen of one cell of an ensemble: figures of the polygon through its nodes, exact for it.
///
/// Long axis and deformation are those of the ellipse with the same second moments of area (the
/// gyration tensor); an affine image of a regular polygon has those of the ellipse around it.
struct CellShape {
  double area = 0;                          // [m^2]
  double perimeter = 0;                     // [m]
  Vector<2> centre = Vector<2>::Zero();     // [m] centroid of the area
  Vector<2> node_mean = Vector<2>::Zero();  // [m] mean of the nodes: what forces and drag move
  Tensor<2> gyration = Tensor<2>::Zero();   // [m^2] (1/A) int X_i X_j dA about the centre
  double inclination = 0;  // [rad] of the long axis against x, in (-pi/2, pi/2]; 0 without one
  double deformation = 0;  // [-] (L - B)/(L + B) of the axes L, B of the ellipse
};

/// @throws NumericalError with cell and area if a ring encloses no positive area
CellShape measure_cell(const EnsembleState& state, std::size_t cell);
std::vector<CellShape> measure_cells(const EnsembleState& state);

}  // namespace hemoscale::micro
