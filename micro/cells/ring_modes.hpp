#pragma once

#include <complex>
#include <vector>

#include "micro/cells/ring_curve.hpp"

namespace hemoscale::micro {

/// Fourier coefficients of the outline over its arc length s, in units of R0 = P / (2 pi):
///
///   c_k = (1 / P) closed int ((x + i y) / R0) exp(-2 pi i k s / P) ds,   k = -order ... order
///
/// The origin of s is where c_1 becomes real and positive, so that the coefficients do not depend
/// on which node is the first, nor on tank-treading. A circle has c_1 = 1 alone; an ellipse c_1 and
/// c_-1; a cell that is symmetric about the direction of the flow has real coefficients but for
/// c_0, its middle. These are the elliptic Fourier descriptors of [KuhlGiardina1982] in complex
/// form: a_k = Re(c_k + c_-k), b_k = -Im(c_k - c_-k) of x, Im(c_k + c_-k) and Re(c_k - c_-k) of y.
struct RingModes {
  int order = 0;
  std::vector<std::complex<double>> coefficients;  // [-] of k = -order first

  std::complex<double> operator()(int k) const {
    return coefficients[static_cast<std::size_t>(k + order)];
  }
};

/// @param order  1 to a third of the number of nodes: shorter waves are not resolved
/// @throws ParameterError
RingModes fourier_modes(const RingCurve& curve, int order);

/// The modes of the same shape turned, shifted and scaled so that neither orientation, place nor
/// size of the cell is left: the long axis of the first ellipse, c_1 and c_-1, is of half length 1
/// along x, and the mean is at the origin. Of the two ways to do so, which differ
/// in the sign of the even modes, that is chosen in which the largest part of c_2 and c_-2, real or
/// imaginary, is positive.
///
/// Not definite where the first ellipse is close to a circle.
RingModes normalised(const RingModes& modes);

}  // namespace hemoscale::micro
