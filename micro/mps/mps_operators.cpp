#include "micro/mps/mps_operators.hpp"

#include <algorithm>

#include "micro/particles/weight.hpp"

namespace hemoscale::micro {

namespace {

template <int dim>
void local_factors(const MpsKernel& kernel, const PairGeometry<dim>& pairs,
                   const NeighbourTable& table, LaplacianWeights& laplacian) {
  const std::size_t count = table.size();
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0;
    double moment = 0;
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      sum += laplacian.weights[k];
      moment += laplacian.weights[k] * pairs.distances[k] * pairs.distances[k];
    }
    if (sum > 0) laplacian.factors[i] = 2.0 * dim * sum / (kernel.laplacian_density * moment);
  }
}

}  // namespace

template <int dim>
void laplacian_weights(const MpsKernel& kernel, LaplacianScale scale,
                       const PairGeometry<dim>& pairs, const NeighbourTable& table,
                       LaplacianWeights& laplacian) {
  const std::size_t entries = table.pairs();
  laplacian.weights.resize(entries);
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < entries; ++k) {
    laplacian.weights[k] = singular_weight(pairs.distances[k], kernel.laplacian_radius);
  }
  laplacian.factors.assign(table.size(),
                           2.0 * dim / (kernel.laplacian_density * kernel.laplacian_second_moment));
  if (scale == LaplacianScale::local) local_factors(kernel, pairs, table, laplacian);
}

template <int dim>
void gradient_weights(const MpsKernel& kernel, const PairGeometry<dim>& pairs,
                      const NeighbourTable& table, std::vector<Vector<dim>>& gradient) {
  const std::size_t entries = table.pairs();
  const double factor = dim / kernel.gradient_density;
  gradient.resize(entries);
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < entries; ++k) {
    const double distance = pairs.distances[k];
    const double weight = singular_weight(distance, kernel.gradient_radius);
    gradient[k] = factor * weight / (distance * distance) * pairs.separations[k];
  }
}

template <int dim>
Stencils<dim> mps_stencils(const MpsKernel& kernel, LaplacianScale scale,
                           const std::vector<Vector<dim>>& positions, const PeriodicBox<dim>& box,
                           const NeighbourTable& table) {
  PairGeometry<dim> pairs;
  measure_pairs(positions, box, table, pairs);
  LaplacianWeights laplacian;
  laplacian_weights(kernel, scale, pairs, table, laplacian);
  Stencils<dim> stencils;
  gradient_weights(kernel, pairs, table, stencils.gradient);
  for (std::size_t i = 0; i < table.size(); ++i) {
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      laplacian.weights[k] *= laplacian.factors[i];
    }
  }
  stencils.laplacian = std::move(laplacian.weights);
  return stencils;
}

#define HEMOSCALE_INSTANTIATE(dim)                                                                 \
  template void laplacian_weights<dim>(const MpsKernel&, LaplacianScale, const PairGeometry<dim>&, \
                                       const NeighbourTable&, LaplacianWeights&);                  \
  template void gradient_weights<dim>(const MpsKernel&, const PairGeometry<dim>&,                  \
                                      const NeighbourTable&, std::vector<Vector<dim>>&);           \
  template Stencils<dim> mps_stencils<dim>(const MpsKernel&, LaplacianScale,                       \
                                           const std::vector<Vector<dim>>&,                        \
                                           const PeriodicBox<dim>&, const NeighbourTable&);
HEMOSCALE_INSTANTIATE(2)
HEMOSCALE_INSTANTIATE(3)
#undef HEMOSCALE_INSTANTIATE

}  // namespace hemoscale::micro
