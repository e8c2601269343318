#include "micro/mps/mps_kernel.hpp"

#include <fmt/format.h>

#include "micro/error.hpp"
#include "micro/mps/reference_density.hpp"

namespace hemoscale::micro {

template <int dim>
MpsKernel mps_kernel(double spacing, double gradient_ratio, double laplacian_ratio) {
  if (!(spacing > 0)) {
    throw ParameterError(fmt::format("the spacing is {:g} m; it must be positive", spacing));
  }
  const ReferenceDensity gradient = reference_density<dim>(gradient_ratio);
  const ReferenceDensity laplacian = reference_density<dim>(laplacian_ratio);
  return {.spacing = spacing,
          .gradient_radius = gradient_ratio * spacing,
          .laplacian_radius = laplacian_ratio * spacing,
          .gradient_density = gradient.density,
          .laplacian_density = laplacian.density,
          .laplacian_second_moment = laplacian.second_moment * spacing * spacing};
}

template MpsKernel mps_kernel<2>(double, double, double);
template MpsKernel mps_kernel<3>(double, double, double);

}  // namespace hemoscale::micro
