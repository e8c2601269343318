#pragma once

namespace hemoscale::macro {

/// How a value inside a cell follows from the values at cell centres.
enum class Interpolation {
  taylor,  ///< second-order Taylor expansion about the centre of the cell; any length scale
  /// The same with least-squares gradients, which are exact for linear flows in any mesh; Gauss
  /// gradients are not where cells are skewed, for instance where blocks of a mesh meet.
  least_squares,
  cell_point,      ///< OpenFOAM's cellPoint: linear in tetrahedra of centre and vertices
  cell_point_face  ///< OpenFOAM's cellPointFace: linear in tetrahedra of centre, face and vertices
};

}  // namespace hemoscale::macro
