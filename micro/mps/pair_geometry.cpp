#include "micro/mps/pair_geometry.hpp"

#include <cmath>

namespace hemoscale::micro {

template <int dim>
void measure_pairs(const std::vector<Vector<dim>>& positions, const PeriodicBox<dim>& box,
                   const NeighbourTable& table, PairGeometry<dim>& pairs) {
  pairs.separations.resize(table.pairs());
  pairs.distances.resize(table.pairs());
  const std::size_t count = table.size();
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      const Vector<dim> r = separation(box, positions[i], positions[table[k]]);
      pairs.separations[k] = r;
      pairs.distances[k] = std::sqrt(r.squaredNorm());
    }
  }
}

template void measure_pairs<2>(const std::vector<Vector<2>>&, const PeriodicBox<2>&,
                               const NeighbourTable&, PairGeometry<2>&);
template void measure_pairs<3>(const std::vector<Vector<3>>&, const PeriodicBox<3>&,
                               const NeighbourTable&, PairGeometry<3>&);

}  // namespace hemoscale::micro
