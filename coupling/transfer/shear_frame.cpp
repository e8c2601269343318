#include "coupling/transfer/shear_frame.hpp"

#include <cmath>

#include "macro/kinematics.hpp"

namespace hemoscale::coupling {

macro::Tensor<2> shear_frame(const macro::Tensor<2>& velocity_gradient) {
  const macro::Tensor<2>& L = velocity_gradient;
  // The part of D without trace is p [[1, 0], [0, -1]] + q [[0, 1], [1, 0]] with
  // sqrt(p^2 + q^2) = shear rate / 2, and its stretching axis lies at half the angle of (p, q).
  const double p = 0.5 * (L(0, 0) - L(1, 1));
  const double q = 0.5 * (L(0, 1) + L(1, 0));
  if (p == 0 && q == 0) return macro::Tensor<2>::Identity();
  const double stretching = 0.5 * std::atan2(q, p);

  // In simple shear u = (rate y, 0) the stretching axis lies 45 degrees above the flow direction
  // and the vorticity L(1,0) - L(0,1) is negative. With positive vorticity the flow direction lies
  // on the other side of the stretching axis, which makes the frame left-handed.
  const double quarter_turn = std::acos(-1.0) / 4;
  const bool mirrored = macro::vorticity(L) > 0;
  const double flow_angle = stretching + (mirrored ? quarter_turn : -quarter_turn);
  const double c = std::cos(flow_angle);
  const double s = std::sin(flow_angle);
  macro::Tensor<2> Q;
  Q.row(0) << c, s;
  if (mirrored) {
    Q.row(1) << s, -c;
  } else {
    Q.row(1) << -s, c;
  }
  return Q;
}

macro::Tensor<2> in_frame(const macro::Tensor<2>& frame, const macro::Tensor<2>& tensor) {
  return frame * tensor * frame.transpose();
}

}  // namespace hemoscale::coupling
