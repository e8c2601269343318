#pragma once

#include <cmath>

namespace hemoscale::micro {

/// Regularised delta function of one coordinate, in units of the node spacing; in the plane the
/// product of two. All shifted by whole spacings add up to one, and so do their first moments: on a
/// lattice forces and torques are kept.
enum class TransferKernel {
  three_point,  // half-width 1.5 (Roma, Peskin and Berger 1999)
  four_point    // half-width 2 (Peskin 2002); odd and even nodes get the same
};

inline double kernel_reach(TransferKernel kernel) {
  return kernel == TransferKernel::three_point ? 1.5 : 2;
}

/// @param r  distance along the coordinate over the spacing
inline double kernel_weight(TransferKernel kernel, double r) {
  const double a = std::abs(r);
  if (kernel == TransferKernel::three_point) {
    if (a <= 0.5) return (1 + std::sqrt(1 - 3 * a * a)) / 3;
    if (a < 1.5) return (5 - 3 * a - std::sqrt(1 - 3 * (1 - a) * (1 - a))) / 6;
    return 0;
  }
  if (a <= 1) return (3 - 2 * a + std::sqrt(1 + 4 * a - 4 * a * a)) / 8;
  if (a < 2) return (5 - 2 * a - std::sqrt(-7 + 12 * a - 4 * a * a)) / 8;
  return 0;
}

/// Fourier transform of the kernel, int phi(r) cos(q r) dr.
/// @param q  wave number times the spacing
double kernel_transform(TransferKernel kernel, double q);

}  // namespace hemoscale::micro
