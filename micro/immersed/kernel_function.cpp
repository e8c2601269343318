#include "micro/immersed/kernel_function.hpp"

namespace hemoscale::micro {

double kernel_transform(TransferKernel kernel, double q) {
  // Midpoint rule; the kernels have kinks of the slope, which cost it its third digit at most.
  constexpr int intervals = 600;
  const double h = kernel_reach(kernel) / intervals;
  double sum = 0;
  for (int i = 0; i < intervals; ++i) {
    const double r = (i + 0.5) * h;
    sum += kernel_weight(kernel, r) * std::cos(q * r);
  }
  return 2 * h * sum;
}

}  // namespace hemoscale::micro
