#pragma once

namespace hemoscale::micro {

/// Discretisation of gradient and Laplacian; one file each.
enum class OperatorKind {
  mps,     // Koshizuka and Oka 1996, as in equations 1 and 2 of Tsubota et al. 2006
  cmps,    // the same with an antisymmetric pressure gradient (Khayyer and Gotoh 2008)
  gc,      // the same with the gradient corrected to be exact for linear fields
  lsmps2,  // least squares, exact for quadratic fields (Tamai and Koshizuka 2014, type A)
};

/// Reference value in the pressure gradient of the moving-particle method.
enum class GradientForm {
  difference,     // p_j - p_i: equation 1 as printed; no repulsion between particles
  minimum,        // p_j - min p: every pair repels (Koshizuka and Oka 1996)
  antisymmetric,  // p_i + p_j - min_i p - min_j p: momentum is conserved (Khayyer and Gotoh 2008)
};

/// Normalisation of the Laplacian of the moving-particle method.
enum class LaplacianScale {
  local,      // the second moment of each particle's neighbourhood: equation 2 as printed
  reference,  // that of the full lattice
};

}  // namespace hemoscale::micro
