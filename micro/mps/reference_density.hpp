#pragma once

namespace hemoscale::micro {

/// Sums over a full square (cubic) lattice of unit spacing around one of its points, with the
/// weight w = radius / r - 1 of the moving-particle method.
struct ReferenceDensity {
  int neighbours = 0;
  double density = 0;        // [-] n0 = sum of w
  double second_moment = 0;  // [l0^2] lambda = sum of r^2 w / sum of w
};

/// @param radius  kernel radius over the spacing; above 1
/// @throws ParameterError otherwise
template <int dim>
ReferenceDensity reference_density(double radius);

/// Largest eigenvalue of minus the Laplacian of the moving-particle method on that lattice, times
/// the spacing squared: the largest value over all wave vectors k of its Fourier symbol
///
///   (2 d / (n0 lambda)) sum_j w_j (1 - cos(k . r_j)).
///
/// An explicit Euler step of the viscous term is stable up to nu dt / l0^2 = 2 / this.
template <int dim>
double largest_laplacian_eigenvalue(double radius);

/// Share of a density deviation that the pressure of the number-density source removes in one step
/// (gamma = 1): for a displacement of wave vector k on that lattice the largest value over k of
///
///   g(k) . s(k) / Lambda(k),   s = radius / n0 sum_j r_j sin(k . r_j) / r_j^3,
///
/// with the symbols g of the gradient and Lambda of the Laplacian. It is not 1, because the density
/// of a lattice responds to compression by radius / (d n0) sum_j 1 / r_j: 1.42 for a radius of 2.1.
template <int dim>
double density_gain(double gradient_radius, double laplacian_radius);

}  // namespace hemoscale::micro
