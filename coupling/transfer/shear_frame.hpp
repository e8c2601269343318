#pragma once

#include "macro/vector.hpp"

namespace hemoscale::coupling {

/// Axes of the micro frame of a plane flow: the rows of the returned orthogonal matrix Q are the
/// flow direction and the gradient direction, so that Q L Q^T = [[a, b], [c, a]] with
/// b >= |c|, b + c = shear rate of the part without divergence, and 2 a = divergence. In simple
/// shear c = 0 and b is the shear rate.
///
/// The principal axes of D lie at 45 degrees to the axes of the frame. Where the vorticity asks for
/// it the frame is left-handed (det Q = -1): a suspension of cells is the same seen in a mirror.
/// Without strain (rest, solid rotation) the frame is that of the flow, Q = 1.
///
/// @param velocity_gradient  L(i,j) = d u_i / d x_j [1/s]
macro::Tensor<2> shear_frame(const macro::Tensor<2>& velocity_gradient);

/// The components in a frame of a tensor given in the frame of the flow: Q A Q^T.
macro::Tensor<2> in_frame(const macro::Tensor<2>& frame, const macro::Tensor<2>& tensor);

}  // namespace hemoscale::coupling
