#pragma once

namespace hemoscale::micro {

/// Kernel radii and reference sums of the moving-particle method.
struct MpsKernel {
  double spacing = 0;                  // [m] l0
  double gradient_radius = 0;          // [m] also that of the particle number density
  double laplacian_radius = 0;         // [m]
  double gradient_density = 0;         // [-] n0 for gradient_radius
  double laplacian_density = 0;        // [-] n0 for laplacian_radius
  double laplacian_second_moment = 0;  // [m^2] lambda of the full lattice

  double largest_radius() const {
    return gradient_radius > laplacian_radius ? gradient_radius : laplacian_radius;
  }
};

/// @param gradient_ratio, laplacian_ratio  kernel radii over the spacing
/// @throws ParameterError for a ratio of 1 or less, or a spacing that is not positive
template <int dim>
MpsKernel mps_kernel(double spacing, double gradient_ratio, double laplacian_ratio);

}  // namespace hemoscale::micro
