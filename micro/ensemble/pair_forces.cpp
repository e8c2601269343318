#include "micro/ensemble/pair_forces.hpp"

namespace hemoscale::micro {

void add_pair_forces(const EnsembleState& state, const NeighbourList& list,
                     const ImageTable& images, const PairPotential& potential, std::size_t first,
                     std::size_t last, double* force_x, double* force_y) {
  const double* const x = state.x.data();
  const double* const y = state.y.data();
  const double* const image_x = images.x.data();
  const double* const image_y = images.y.data();
  const PairPotential law = potential;
  for (std::size_t i = first; i < last; ++i) {
    double sum_x = force_x[i];
    double sum_y = force_y[i];
    for (const Neighbour& other : list.of(i)) {
      const auto image = static_cast<std::size_t>(other.image);
      const auto j = static_cast<std::size_t>(other.node);
      const double dx = x[i] - (x[j] + image_x[image]);
      const double dy = y[i] - (y[j] + image_y[image]);
      const double f = law.force_over_distance(dx * dx + dy * dy);
      sum_x += f * dx;
      sum_y += f * dy;
    }
    force_x[i] = sum_x;
    force_y[i] = sum_y;
  }
}

PairSums sum_pairs(const EnsembleState& state, const NeighbourList& list, const ImageTable& images,
                   const PairPotential& potential, std::size_t first, std::size_t last) {
  PairSums sums;
  for (std::size_t i = first; i < last; ++i) {
    for (const Neighbour& other : list.of(i)) {
      const auto image = static_cast<std::size_t>(other.image);
      const auto j = static_cast<std::size_t>(other.node);
      const Vector<2> d(state.x[i] - (state.x[j] + images.x[image]),
                        state.y[i] - (state.y[j] + images.y[image]));
      const double s = d.squaredNorm();
      if (s < potential.cutoff_squared) {
        sums.energy += 0.5 * potential.energy(s);
        sums.virial += (0.5 * potential.force_over_distance(s)) * d * d.transpose();
      }
    }
  }
  return sums;
}

}  // namespace hemoscale::micro
