#include "micro/mps/number_density.hpp"

#include "micro/particles/weight.hpp"

namespace hemoscale::micro {

template <int dim>
void number_density(const MpsKernel& kernel, const PairGeometry<dim>& pairs,
                    const NeighbourTable& table, std::vector<double>& density) {
  const std::size_t count = table.size();
  density.resize(count);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0;
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      sum += singular_weight(pairs.distances[k], kernel.gradient_radius);
    }
    density[i] = sum;
  }
}

template <int dim>
void density_rate(const MpsKernel& kernel, const PairGeometry<dim>& pairs,
                  const NeighbourTable& table, const std::vector<Vector<dim>>& velocities,
                  std::vector<double>& rate) {
  const std::size_t count = table.size();
  rate.resize(count);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0;
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      const double r = pairs.distances[k];
      if (r >= kernel.gradient_radius) continue;
      sum += pairs.separations[k].dot(velocities[table[k]] - velocities[i]) / (r * r * r);
    }
    rate[i] = -kernel.gradient_radius * sum;
  }
}

#define HEMOSCALE_INSTANTIATE(dim)                                                        \
  template void number_density<dim>(const MpsKernel&, const PairGeometry<dim>&,           \
                                    const NeighbourTable&, std::vector<double>&);         \
  template void density_rate<dim>(const MpsKernel&, const PairGeometry<dim>&,             \
                                  const NeighbourTable&, const std::vector<Vector<dim>>&, \
                                  std::vector<double>&);
HEMOSCALE_INSTANTIATE(2)
HEMOSCALE_INSTANTIATE(3)
#undef HEMOSCALE_INSTANTIATE

}  // namespace hemoscale::micro
