#include "micro/mps/particle_shifting.hpp"

namespace hemoscale::micro {

namespace {

/// Gradient of n / n0 times l0^2 [m].
template <int dim>
void scaled_density_gradient(const MpsKernel& kernel, const PairGeometry<dim>& pairs,
                             const NeighbourTable& table, std::vector<Vector<dim>>& gradients) {
  const double factor =
      kernel.spacing * kernel.spacing * kernel.gradient_radius / kernel.gradient_density;
  const std::size_t count = table.size();
  gradients.resize(count);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    Vector<dim> sum = Vector<dim>::Zero();
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      const double r = pairs.distances[k];
      if (r < kernel.gradient_radius) sum += pairs.separations[k] / (r * r * r);
    }
    gradients[i] = factor * sum;
  }
}

bool is_near_surface(const NeighbourTable& table, const std::vector<ParticleKind>& kinds,
                     std::size_t i) {
  if (kinds[i] == ParticleKind::surface) return true;
  for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
    if (kinds[table[k]] == ParticleKind::surface) return true;
  }
  return false;
}

/// The displacement without its part along the mean of those around it.
template <int dim>
Vector<dim> along_surface(const NeighbourTable& table, const std::vector<Vector<dim>>& gradients,
                          std::size_t i) {
  Vector<dim> normal = gradients[i];
  for (std::size_t k = table.begin(i); k < table.end(i); ++k) normal += gradients[table[k]];
  const double squared = normal.squaredNorm();
  if (!(squared > 0)) return Vector<dim>::Zero();
  return gradients[i] - gradients[i].dot(normal) / squared * normal;
}

}  // namespace

template <int dim>
void shift_displacements(const MpsKernel& kernel, ShiftKind kind, double coefficient,
                         const PairGeometry<dim>& pairs, const NeighbourTable& table,
                         const std::vector<ParticleKind>& kinds,
                         std::vector<Vector<dim>>& displacements) {
  std::vector<Vector<dim>> gradients;
  scaled_density_gradient(kernel, pairs, table, gradients);
  const bool is_optimized = kind == ShiftKind::ops;
  const std::size_t count = table.size();
  displacements.resize(count);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    Vector<dim> towards = Vector<dim>::Zero();
    if (is_optimized && is_near_surface(table, kinds, i)) {
      if (kinds[i] == ParticleKind::fluid || kinds[i] == ParticleKind::surface) {
        towards = along_surface(table, gradients, i);
      }
    } else if (kinds[i] == ParticleKind::fluid) {
      towards = gradients[i];
    }
    displacements[i] = -coefficient * towards;
  }
}

template <int dim>
void follow(ShiftInterpolation interpolation, const std::vector<Vector<dim>>& gradient,
            const NeighbourTable& table, const std::vector<Vector<dim>>& displacements,
            std::vector<double>& field) {
  if (interpolation == ShiftInterpolation::none) return;
  const std::size_t count = table.size();
  std::vector<Vector<dim>> slopes(count);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    Vector<dim> sum = Vector<dim>::Zero();
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      sum += (field[table[k]] - field[i]) * gradient[k];
    }
    slopes[i] = sum;
  }
  const bool is_second = interpolation == ShiftInterpolation::second_order;
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    const Vector<dim>& d = displacements[i];
    double change = slopes[i].dot(d);
    for (std::size_t k = table.begin(i); is_second && k < table.end(i); ++k) {
      change += 0.5 * gradient[k].dot(d) * (slopes[table[k]] - slopes[i]).dot(d);
    }
    field[i] += change;
  }
}

#define HEMOSCALE_INSTANTIATE(dim)                                                          \
  template void shift_displacements<dim>(                                                   \
      const MpsKernel&, ShiftKind, double, const PairGeometry<dim>&, const NeighbourTable&, \
      const std::vector<ParticleKind>&, std::vector<Vector<dim>>&);                         \
  template void follow<dim>(ShiftInterpolation, const std::vector<Vector<dim>>&,            \
                            const NeighbourTable&, const std::vector<Vector<dim>>&,         \
                            std::vector<double>&);
HEMOSCALE_INSTANTIATE(2)
HEMOSCALE_INSTANTIATE(3)
#undef HEMOSCALE_INSTANTIATE

}  // namespace hemoscale::micro
