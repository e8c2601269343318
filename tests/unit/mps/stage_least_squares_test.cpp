#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "micro/error.hpp"
#include "micro/mps/least_squares.hpp"
#include "micro/mps/node_domains.hpp"
#include "micro/mps/stage_limits.hpp"

namespace hemoscale::micro {
namespace {

using testing::HasSubstr;

/// a + b.x + x.C x / 2
template <int dim>
struct Quadratic {
  double a = 1.5;
  Vector<dim> b;
  Tensor<dim> c;

  Quadratic() {
    for (int i = 0; i < dim; ++i) {
      b[i] = 0.7 - i;
      for (int j = 0; j < dim; ++j) c(i, j) = 1.0 / (1 + i + j) - (i == j ? 2.0 : 0.0);
    }
  }
  double operator()(const Vector<dim>& x) const { return a + b.dot(x) + x.dot(c * x) / 2; }
  Vector<dim> gradient(const Vector<dim>& x) const { return b + c * x; }
  double laplacian() const { return c.trace(); }
};

template <int dim>
void expect_exact(const FlowDomain<dim>& domain, double radius) {
  const ParticleSet<dim>& particles = domain.particles;
  NeighbourTable table;
  table.build<dim>(particles.positions, domain.box, radius);
  FitQuality quality;
  const auto stencils = least_squares_stencils<dim>({.radius = radius}, particles.positions,
                                                    domain.box, table, &quality);
  EXPECT_GT(quality.largest_condition, 1);
  const Quadratic<dim> field;
  std::vector<double> values;
  for (const Vector<dim>& x : particles.positions) values.push_back(field(x));
  std::vector<Vector<dim>> gradient;
  std::vector<double> laplacian;
  apply_gradient(stencils, table, values, gradient);
  apply_laplacian(stencils, table, values, laplacian);
  std::vector<Vector<dim>> linear;
  for (const Vector<dim>& x : particles.positions) linear.push_back(field.c * x);
  std::vector<double> divergence;
  std::vector<Vector<dim>> of_linear;
  apply_divergence(stencils, table, linear, divergence);
  apply_laplacian(stencils, table, linear, of_linear);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    EXPECT_NEAR((gradient[i] - field.gradient(particles.positions[i])).norm(), 0, 1e-11);
    EXPECT_NEAR(laplacian[i], field.laplacian(), 1e-9);
    EXPECT_NEAR(divergence[i], field.c.trace(), 1e-11);
    EXPECT_NEAR(of_linear[i].norm(), 0, 1e-9);
    EXPECT_NEAR((velocity_gradient(stencils, table, linear, i) - field.c).norm(), 0, 1e-11);
  }
}

TEST(LeastSquares, is_exact_for_quadratic_fields_on_disordered_nodes_and_at_walls) {
  expect_exact<2>(channel_nodes(2, 1, false, {.spacing = 0.1, .disorder = 0.2, .seed = 3}), 0.25);
  expect_exact<2>(channel_nodes(2, 1, false, {.spacing = 0.1, .disorder = 0.2, .seed = 4}), 0.31);
  expect_exact<3>(pipe_nodes(1, 0.5, false, {.spacing = 0.125, .disorder = 0.2, .seed = 5}), 0.35);
}

TEST(LeastSquares, derivatives_and_interpolation_are_exact_for_quadratic_fields) {
  const auto domain = channel_nodes(2, 1, false, {.spacing = 0.1, .disorder = 0.2, .seed = 3});
  const auto& x = domain.particles.positions;
  const Quadratic<2> field;
  std::vector<double> pressures;
  std::vector<Vector<2>> velocities;
  for (const Vector<2>& at : x) {
    pressures.push_back(field(at));
    velocities.emplace_back(2 * field(at), at[0] * at[1]);
  }
  const LeastSquares fit{.radius = 0.25};
  NeighbourTable table;
  table.build<2>(x, domain.box, fit.radius);
  for (const std::size_t i : {std::size_t{0}, std::size_t{57}, x.size() - 1}) {
    const auto d = flow_derivatives<2>(fit, x, domain.box, table, velocities, pressures, i);
    EXPECT_NEAR((d.pressure.gradient - field.gradient(x[i])).norm(), 0, 1e-11);
    EXPECT_NEAR((d.pressure.hessian - field.c).norm(), 0, 1e-9);
    EXPECT_NEAR((d.velocity[0].hessian - 2 * field.c).norm(), 0, 1e-9);
    EXPECT_NEAR(d.velocity[1].hessian(0, 1), 1, 1e-9);
  }
  const std::vector<Vector<2>> points = {{0.33, 0.77}, {1.2, 0.01}, {1.999, 0.5}};
  const auto samples = interpolate_flow<2>(fit, x, domain.box, velocities, pressures, points);
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_NEAR(samples[k].pressure, field(points[k]), 1e-11);
    EXPECT_NEAR(samples[k].velocity[1], points[k][0] * points[k][1], 1e-11);
    EXPECT_NEAR(samples[k].velocity_gradient(1, 0), points[k][1], 1e-9);
    EXPECT_NEAR(samples[k].velocity_gradient(0, 1), 2 * field.gradient(points[k])[1], 1e-9);
  }
}

TEST(LeastSquares, names_the_particle_whose_moments_are_singular) {
  std::vector<Vector<2>> row;  // all in a line: nothing is known across
  for (int i = 0; i < 8; ++i) row.emplace_back(0.1 * i, 0.0);
  NeighbourTable table;
  table.build<2>(row, {}, 0.25);
  try {
    least_squares_stencils<2>({.radius = 0.25}, row, {}, table);
    FAIL() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("particle 0 at (0, 0) m has 2 neighbours"));
    EXPECT_THAT(error.what(), HasSubstr("moment matrix"));
    EXPECT_THAT(error.what(), HasSubstr("enlarge the kernel radius"));
  }
  EXPECT_THROW(
      interpolate_flow<2>({.radius = 0.25}, row, {}, row, std::vector<double>(8), {{0.3, 0.1}}),
      NumericalError);
}

TEST(LeastSquares, condition_bound_is_sharp) {
  const auto domain = channel_nodes(1, 1, false, {.spacing = 0.1});
  NeighbourTable table;
  table.build<2>(domain.particles.positions, domain.box, 0.25);
  FitQuality quality;
  const auto build = [&](double bound) {
    return least_squares_stencils<2>({.radius = 0.25, .condition_bound = bound},
                                     domain.particles.positions, domain.box, table, &quality);
  };
  build(1e8);
  const double largest = quality.largest_condition;
  EXPECT_NO_THROW(build(1.0001 * largest));
  EXPECT_THROW(build(0.9999 * largest), NumericalError);
}

TEST(StageLimits, laplacian_of_waves_of_two_spacings_is_not_above_the_largest_eigenvalue) {
  // Direct: apply the operator to cos(pi (x + y)) and to cos(pi x) on a periodic lattice.
  for (const double ratio : {2.1, 2.5, 3.1}) {
    const double largest = largest_least_squares_eigenvalue<2>(ratio);
    const auto domain = periodic_nodes<2>({16, 16}, {.spacing = 1});
    NeighbourTable table;
    table.build<2>(domain.particles.positions, domain.box, ratio);
    const auto stencils =
        least_squares_stencils<2>({.radius = ratio}, domain.particles.positions, domain.box, table);
    double seen = 0;
    for (int a = 0; a <= 8; ++a) {
      for (int b = 0; b <= 8; ++b) {
        std::vector<double> wave;
        const Vector<2> k(2 * M_PI * a / 16, 2 * M_PI * b / 16);
        for (const Vector<2>& x : domain.particles.positions) wave.push_back(std::cos(k.dot(x)));
        std::vector<double> result;
        apply_laplacian(stencils, table, wave, result);
        const std::size_t i = 0;
        if (std::abs(wave[i]) > 0.1) seen = std::max(seen, -result[i] / wave[i]);
      }
    }
    EXPECT_NEAR(seen, largest, 0.03 * largest) << "ratio " << ratio;
  }
}

}  // namespace
}  // namespace hemoscale::micro
