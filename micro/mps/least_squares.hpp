#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "micro/mps/stencils.hpp"

namespace hemoscale::micro {

/// Weighted least squares of degree two with the weight (1 - r / radius)^2.
struct LeastSquares {
  double radius = 0;             // [m] of the weight
  double condition_bound = 1e8;  // [-] of a moment matrix, in the 1-norm
};

/// How well the fits of a particle set are determined.
struct FitQuality {
  double largest_condition = 0;  // [-] of all moment matrices
  std::size_t particle = 0;      // where
};

/// Gradient and Laplacian of the least-squares moving-particle method, type A of degree two (Tamai
/// and Koshizuka 2014): with the monomials q(r) = (x, y, x^2/2, xy, y^2/2) (nine in three
/// dimensions) of the scaled distance, the derivatives at particle i are the coefficients a of the
/// parabola through phi_i that fits its neighbours best,
///
///   a_i = M_i^-1 sum_j w q(r_ij) (phi_j - phi_i),   M_i = sum_j w q q^T.
///
/// Exact for quadratic fields on any particles, one-sided neighbourhoods included, so that walls
/// need no particles behind them. First order for the Laplacian and second for the gradient of
/// others; on symmetric neighbourhoods second for both.
///
/// @param table  holds all pairs within the radius
/// @param ranks  with more than one, each computes its own rows; collective
/// @throws NumericalError naming the particle, its place, its neighbours and the condition number
///         if a moment matrix is singular or its condition number above the bound
template <int dim>
Stencils<dim> least_squares_stencils(const LeastSquares& fit,
                                     const std::vector<Vector<dim>>& positions,
                                     const PeriodicBox<dim>& box, const NeighbourTable& table,
                                     FitQuality* quality = nullptr,
                                     const Communicator* ranks = nullptr);

/// Weights of the Laplacian at the last of some points as differences to the others [1/m^2].
/// @throws NumericalError as above
template <int dim>
std::vector<double> laplacian_weights(const LeastSquares& fit,
                                      const std::vector<Vector<dim>>& points);

/// First and second derivatives of each of the fields at a particle.
template <int dim>
struct Derivatives {
  Vector<dim> gradient = Vector<dim>::Zero();  // [1/m]
  Tensor<dim> hessian = Tensor<dim>::Zero();   // [1/m^2]
};

/// Derivatives of the components of `velocities` and of `pressures` at one particle, by the same
/// fit: for moving particles without losing order.
/// @throws NumericalError as above
template <int dim>
struct FlowDerivatives {
  std::array<Derivatives<dim>, static_cast<std::size_t>(dim)> velocity;  // of each component
  Derivatives<dim> pressure;
};
template <int dim>
FlowDerivatives<dim> flow_derivatives(const LeastSquares& fit,
                                      const std::vector<Vector<dim>>& positions,
                                      const PeriodicBox<dim>& box, const NeighbourTable& table,
                                      const std::vector<Vector<dim>>& velocities,
                                      const std::vector<double>& pressures, std::size_t particle);

/// The flow at any points, by parabolas fitted to the particles around each (degree two, with a
/// constant: type B). Exact for quadratic fields.
/// @throws NumericalError naming the point if too few particles are near it
template <int dim>
struct FlowSample {
  Vector<dim> velocity = Vector<dim>::Zero();           // [m/s]
  Tensor<dim> velocity_gradient = Tensor<dim>::Zero();  // [1/s] L(i,j) = d u_i / d x_j
  double pressure = 0;                                  // [Pa]
};
template <int dim>
std::vector<FlowSample<dim>> interpolate_flow(const LeastSquares& fit,
                                              const std::vector<Vector<dim>>& positions,
                                              const PeriodicBox<dim>& box,
                                              const std::vector<Vector<dim>>& velocities,
                                              const std::vector<double>& pressures,
                                              const std::vector<Vector<dim>>& points);

}  // namespace hemoscale::micro
