#include "micro/mps/node_sampler.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "micro/error.hpp"
#include "tests/support/mps/lattices.hpp"

namespace hemoscale::micro {
namespace {

template <int dim>
PeriodicBox<dim> box(double length, bool is_periodic) {
  PeriodicBox<dim> result;
  result.lower.setZero();
  result.upper.setConstant(length);
  result.periodic.fill(is_periodic);
  return result;
}

template <int dim>
double quadratic(const Vector<dim>& x) {
  double sum = 0.7;
  for (int a = 0; a < dim; ++a) {
    sum += (a - 1.5) * x[a];
    for (int b = a; b < dim; ++b) sum += (1 + a - 2 * b) * x[a] * x[b];
  }
  return sum;
}

template <int dim>
void is_exact_for_quadratics() {
  const test::Cloud<dim> cloud = test::lattice_cloud<dim>(box<dim>(1, false), 0.1, 0.3);
  const NodeSampler<dim> sampler(cloud.positions, cloud.box, 0.25);
  std::vector<double> values;
  std::vector<Vector<dim>> vectors;
  for (const Vector<dim>& x : cloud.positions) {
    values.push_back(quadratic<dim>(x));
    vectors.push_back(Vector<dim>::Unit(1) * quadratic<dim>(x));
  }
  // In the middle, near a corner, and beside the nodes.
  Vector<dim> corner = Vector<dim>::Constant(0.08);
  corner[0] = 0.93;
  const std::vector<Vector<dim>> points = {Vector<dim>::Constant(0.513), corner,
                                           Vector<dim>::Constant(0.02)};
  const SampleWeights weights = sampler.weights(points);
  const std::vector<Tensor<dim>> gradients = sampler.gradients(points, vectors);
  ASSERT_EQ(weights.size(), points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_NEAR(weights.sample(p, values), quadratic<dim>(points[p]), 1e-11);
    for (int a = 0; a < dim; ++a) {
      const Vector<dim> d = 1e-4 * Vector<dim>::Unit(a);
      const double slope = (quadratic<dim>(points[p] + d) - quadratic<dim>(points[p] - d)) / 2e-4;
      EXPECT_NEAR(gradients[p](1, a), slope, 1e-9);
      EXPECT_NEAR(gradients[p](0, a), 0, 1e-12);
    }
  }
}

TEST(NodeSampler, is_exact_for_quadratic_fields) {
  is_exact_for_quadratics<2>();
  is_exact_for_quadratics<3>();
}

double wave_error(int rows) {
  const double pi = std::acos(-1.0);
  const auto wave = [&](const Vector<2>& x) {
    return std::sin(2 * pi * x[0]) * std::cos(2 * pi * x[1]);
  };
  const test::Cloud<2> cloud = test::lattice_cloud<2>(box<2>(1, true), 1.0 / rows, 0.2);
  const NodeSampler<2> sampler(cloud.positions, cloud.box, 2.5 / rows);
  std::vector<double> values;
  for (const Vector<2>& x : cloud.positions) values.push_back(wave(x));
  // Around the joints, and one and two periods away.
  std::vector<Vector<2>> points;
  for (int k = 0; k < 40; ++k) points.emplace_back(0.03 * k - 0.01, 0.999 + 0.02 * k);
  const SampleWeights weights = sampler.weights(points);
  double error = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    error = std::max(error, std::abs(weights.sample(p, values) - wave(points[p])));
  }
  return error;
}

TEST(NodeSampler, is_of_third_order_across_periodic_joints) {
  const double coarse = wave_error(20);
  const double fine = wave_error(40);
  EXPECT_LT(coarse, 0.02);
  EXPECT_GT(std::log2(coarse / fine), 2.6);
}

TEST(NodeSampler, refuses_a_period_in_which_a_fit_may_meet_itself) {
  PeriodicBox<2> narrow = box<2>(1, false);
  narrow.upper = {0.5, 1};
  narrow.periodic[0] = true;
  const test::Cloud<2> cloud = test::lattice_cloud<2>(narrow, 0.1, 0.2);
  EXPECT_THROW(NodeSampler<2>(cloud.positions, cloud.box, 0.25), ParameterError);
  EXPECT_NO_THROW(NodeSampler<2>(cloud.positions, cloud.box, 0.1));
}

TEST(NodeSampler, says_where_nodes_are_missing) {
  const test::Cloud<2> cloud = test::lattice_cloud<2>(box<2>(1, false), 0.1, 0.2);
  const NodeSampler<2> sampler(cloud.positions, cloud.box, 0.25);
  try {
    sampler.weights({{0.5, 0.5}, {0.5, 1.5}});
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("(0.5, 1.5) m cannot be interpolated: 0 nodes"));
    EXPECT_THAT(error.what(), testing::HasSubstr("is the point in the fluid?"));
  }
  // Nodes in a row determine no parabola across it.
  std::vector<Vector<2>> row;
  for (int k = 0; k < 12; ++k) row.emplace_back(0.1 * k, 0);
  const NodeSampler<2> in_a_row(row, {}, 0.6);
  EXPECT_THROW(in_a_row.weights({{0.5, 0}}), NumericalError);
}

}  // namespace
}  // namespace hemoscale::micro
