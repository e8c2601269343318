#include "macro/analytic/decaying_flows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "macro/error.hpp"

namespace hemoscale::macro {
namespace {

/// Largest residual of momentum over `scale` and of continuity at some points, by differences.
template <int dim>
double momentum_residual(const FlowField<dim>& flow, double nu, double density, bool with_inertia) {
  const double h = 1e-4;
  const double t = 0.3;
  double worst = 0;
  for (int p = 0; p < 5; ++p) {
    Vector<dim> x;
    for (int i = 0; i < dim; ++i) x[i] = 0.13 + 0.17 * p + 0.29 * i;
    const FlowState<dim> here = *flow.at(x, t);
    Vector<dim> laplacian = Vector<dim>::Zero();
    Vector<dim> pressure = Vector<dim>::Zero();
    for (int i = 0; i < dim; ++i) {
      Vector<dim> step = Vector<dim>::Zero();
      step[i] = h;
      const FlowState<dim> before = *flow.at(x - step, t);
      const FlowState<dim> after = *flow.at(x + step, t);
      laplacian += (before.velocity + after.velocity - 2 * here.velocity) / (h * h);
      pressure[i] = (after.pressure - before.pressure) / (2 * h);
      const Vector<dim> slope = (after.velocity - before.velocity) / (2 * h);
      EXPECT_NEAR((slope - here.velocity_gradient.col(i)).norm(), 0, 1e-5);
    }
    EXPECT_NEAR(here.velocity_gradient.trace(), 0, 1e-12);
    const Vector<dim> rate = (flow.at(x, t + h)->velocity - flow.at(x, t - h)->velocity) / (2 * h);
    Vector<dim> residual = rate + pressure / density - nu * laplacian;
    if (with_inertia) residual += here.velocity_gradient * here.velocity;
    worst = std::max(worst, residual.norm());
  }
  return worst;
}

TEST(TaylorGreen, satisfies_the_equations_of_motion) {
  const TaylorGreen<2> plane({.length = 2, .speed = 1.5, .viscosity = 0.02, .density = 2});
  EXPECT_LT(momentum_residual<2>(plane, 0.01, 2, true), 1e-4);
  const TaylorGreen<3> space({.length = 2, .speed = 1.5, .viscosity = 0.02, .density = 2});
  EXPECT_LT(momentum_residual<3>(space, 0.01, 2, false), 1e-4);  // Stokes flow
}

TEST(ShearWave, satisfies_the_equations_of_motion) {
  const ShearWave wave({.height = 2, .rate = 3, .speed = 1.5, .viscosity = 0.02, .density = 2});
  EXPECT_LT(momentum_residual<2>(wave, 0.01, 2, true), 1e-4);
}

TEST(DecayingFlows, refuse_parameters_that_make_no_flow) {
  EXPECT_THROW(TaylorGreen<2>({.length = 0, .speed = 1, .viscosity = 1, .density = 1}),
               ParameterError);
  EXPECT_THROW(TaylorGreen<2>({.length = 1, .speed = 1, .viscosity = -1, .density = 1}),
               ParameterError);
  EXPECT_THROW(TaylorGreen<2>({.length = 1, .speed = 1, .viscosity = 1, .density = 0}),
               ParameterError);
  EXPECT_THROW(ShearWave({.height = 0, .rate = 1, .speed = 1, .viscosity = 1, .density = 1}),
               ParameterError);
}

}  // namespace
}  // namespace hemoscale::macro
