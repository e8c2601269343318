#pragma once

#include <optional>
#include <vector>

#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Velocity along a plane channel, tabulated at equally spaced heights from wall to wall.
struct VelocityProfile {
  double height = 0;               // [m] distance between the walls y = 0 and y = height
  std::vector<double> velocities;  // [m/s] at y = k * height / (size - 1); at least four
};

/// What the flow imposes on one micro domain, in the frame of that domain: the first axis along
/// the flow, the second along the gradient.
template <int dim>
struct Forcing {
  Tensor<dim> velocity_gradient = Tensor<dim>::Zero();  // [1/s] L(i,j) = d u_i / d x_j
  Vector<dim> body_force = Vector<dim>::Zero();         // [N/m^3] minus the pressure gradient
  double hematocrit = 0;  // [-] volume (2-D: area) fraction of red cells
  std::optional<VelocityProfile> profile = std::nullopt;  // channel domains only
};

}  // namespace hemoscale::micro
