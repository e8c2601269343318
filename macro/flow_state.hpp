#pragma once

#include "macro/vector.hpp"

namespace hemoscale::macro {

/// The flow at one point and time.
template <int dim>
struct FlowState {
  Vector<dim> velocity = Vector<dim>::Zero();           // [m/s]
  Tensor<dim> velocity_gradient = Tensor<dim>::Zero();  // [1/s] L(i,j) = d u_i / d x_j
  double pressure = 0;                                  // [Pa]
};

}  // namespace hemoscale::macro
