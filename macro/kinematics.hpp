#pragma once

#include <cmath>
#include <optional>

#include "macro/vector.hpp"

namespace hemoscale::macro {

// Invariants of a velocity gradient L(i,j) = d u_i / d x_j [1/s], the one definition of the
// project.
//
// Trap: OpenFOAM's grad(U) is the transpose of L. The rate of deformation and the shear rate do
// not notice; the vorticity changes sign. Arguments are plain matrices: write
// `Tensor<dim>(L.transpose())` to pass an Eigen expression.

/// D = (L + L^T) / 2 [1/s].
template <int dim>
Tensor<dim> rate_of_deformation(const Tensor<dim>& L) {
  return 0.5 * (L + L.transpose());
}

/// W = (L - L^T) / 2 [1/s]; a rigid rotation has D = 0 and W = L.
template <int dim>
Tensor<dim> spin(const Tensor<dim>& L) {
  return 0.5 * (L - L.transpose());
}

/// sqrt(2 D:D) [1/s]; |du/dy| in simple shear, also where L is asymmetric. For incompressible flow:
/// a trace of L would count as deformation.
template <int dim>
double shear_rate(const Tensor<dim>& L) {
  return std::sqrt(2.0) * rate_of_deformation<dim>(L).norm();
}

/// curl u in the plane, d u_y / d x - d u_x / d y [1/s]; positive is anticlockwise.
inline double vorticity(const Tensor<2>& L) {
  return L(1, 0) - L(0, 1);
}

/// curl u [1/s].
inline Vector<3> vorticity(const Tensor<3>& L) {
  return {L(2, 1) - L(1, 2), L(0, 2) - L(2, 0), L(1, 0) - L(0, 1)};
}

/// How much of the motion is deformation: (|D| - |W|) / (|D| + |W|) with Frobenius norms [-].
/// -1 rigid rotation, 0 simple shear, 1 pure extension (Fuller and Leal 1980, where it is called
/// alpha, for plane flows). Not invariant under a change to a rotating frame.
///
/// @returns  empty where L is zero, since there is no motion to classify
template <int dim>
std::optional<double> flow_type(const Tensor<dim>& L) {
  const double deformation = rate_of_deformation<dim>(L).norm();
  const double rotation = spin<dim>(L).norm();
  if (deformation + rotation == 0) return std::nullopt;
  return (deformation - rotation) / (deformation + rotation);
}

}  // namespace hemoscale::macro
