#include "micro/mps/reference_density.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "micro/error.hpp"
#include "micro/particles/lattice_points.hpp"
#include "micro/particles/weight.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

namespace {

template <int dim>
std::vector<Vector<dim>> lattice_neighbours(double radius) {
  if (!(radius > 1) || radius > 20) {
    throw ParameterError(fmt::format(
        "the kernel radius is {:g} spacings; it must be above 1 (or a particle has no neighbours) "
        "and at most 20",
        radius));
  }
  return lattice_points<dim>(radius);
}

template <int dim>
double laplacian_symbol(const std::vector<Vector<dim>>& lattice, double radius,
                        const Vector<dim>& wave) {
  double sum = 0;
  for (const Vector<dim>& r : lattice) {
    sum += singular_weight(r.norm(), radius) * (1 - std::cos(wave.dot(r)));
  }
  return sum;
}

/// Largest value of a smooth, even function of the wave vector: a coarse search over the octant,
/// then ever finer ones around the best.
template <int dim, typename Function>
double largest_over_waves(const Function& function) {
  Vector<dim> best = Vector<dim>::Constant(std::numbers::pi / 2);
  double largest = 0;
  double half_width = std::numbers::pi / 2;
  for (int round = 0; round < 12; ++round) {
    const Vector<dim> centre = best;
    const int points = round == 0 ? 24 : 4;
    const int depth = dim == 3 ? points : 0;
    for (int a = -points; a <= points; ++a) {
      for (int b = -points; b <= points; ++b) {
        for (int c = -depth; c <= depth; ++c) {
          Vector<dim> wave = centre;
          wave[0] += half_width * a / points;
          wave[1] += half_width * b / points;
          if constexpr (dim == 3) wave[2] += half_width * c / points;
          const double value = function(wave);
          if (value > largest) {
            largest = value;
            best = wave;
          }
        }
      }
    }
    half_width /= round == 0 ? 12 : 2;
  }
  return largest;
}

}  // namespace

template <int dim>
ReferenceDensity reference_density(double radius) {
  ReferenceDensity sums;
  double moment = 0;
  for (const Vector<dim>& r : lattice_neighbours<dim>(radius)) {
    const double weight = singular_weight(r.norm(), radius);
    ++sums.neighbours;
    sums.density += weight;
    moment += weight * r.squaredNorm();
  }
  sums.second_moment = moment / sums.density;
  return sums;
}

template <int dim>
double largest_laplacian_eigenvalue(double radius) {
  const std::vector<Vector<dim>> lattice = lattice_neighbours<dim>(radius);
  const double largest = largest_over_waves<dim>(
      [&](const Vector<dim>& wave) { return laplacian_symbol<dim>(lattice, radius, wave); });
  const ReferenceDensity sums = reference_density<dim>(radius);
  return 2.0 * dim / (sums.density * sums.second_moment) * largest;
}

template <int dim>
double density_gain(double gradient_radius, double laplacian_radius) {
  const std::vector<Vector<dim>> near = lattice_neighbours<dim>(gradient_radius);
  const std::vector<Vector<dim>> far = lattice_neighbours<dim>(laplacian_radius);
  const double largest = largest_over_waves<dim>([&](const Vector<dim>& wave) {
    constexpr double too_long = 1e-3;  // both symbols vanish with the wave vector
    if (wave.norm() < too_long) return 0.0;
    Vector<dim> gradient = Vector<dim>::Zero();
    Vector<dim> response = Vector<dim>::Zero();
    for (const Vector<dim>& r : near) {
      const double squared = r.squaredNorm();
      const double sine = std::sin(wave.dot(r));
      gradient += singular_weight(std::sqrt(squared), gradient_radius) / squared * sine * r;
      response += sine / (squared * std::sqrt(squared)) * r;
    }
    return gradient.dot(response) / laplacian_symbol<dim>(far, laplacian_radius, wave);
  });
  const ReferenceDensity inner = reference_density<dim>(gradient_radius);
  const ReferenceDensity outer = reference_density<dim>(laplacian_radius);
  const double gradient_factor = dim / inner.density;
  const double response_factor = gradient_radius / inner.density;
  const double laplacian_factor = 2.0 * dim / (outer.density * outer.second_moment);
  return gradient_factor * response_factor / laplacian_factor * largest;
}

template ReferenceDensity reference_density<2>(double);
template ReferenceDensity reference_density<3>(double);
template double largest_laplacian_eigenvalue<2>(double);
template double largest_laplacian_eigenvalue<3>(double);
template double density_gain<2>(double, double);
template double density_gain<3>(double, double);

}  // namespace hemoscale::micro
