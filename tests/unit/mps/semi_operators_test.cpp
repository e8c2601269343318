#include <gtest/gtest.h>

#include <cmath>

#include "micro/mps/corrected_gradient.hpp"
#include "micro/mps/mps_operators.hpp"
#include "micro/mps/number_density.hpp"
#include "micro/mps/particle_shifting.hpp"
#include "micro/mps/pressure_gradient.hpp"
#include "tests/support/mps/lattices.hpp"

namespace hemoscale::micro {
namespace {

constexpr double length = 60;

test::Cloud<2> disordered(double jitter, double radius = 2.1) {
  test::Cloud<2> cloud = test::lattice_cloud<2>(
      {.lower = {0, 0}, .upper = {length, length}, .periodic = {false, false}}, 1, jitter);
  cloud.search(radius);
  return cloud;
}

bool is_inner(const Vector<2>& x) {
  return (x.array() > 5).all() && (x.array() < length - 5).all();
}

struct JitterCase {
  double radius, jitter, error;
};

class JitteredGradient : public testing::TestWithParam<JitterCase> {};

// Root mean square errors of the gradient of a linear field, from an independent program.
INSTANTIATE_TEST_SUITE_P(, JitteredGradient,
                         testing::Values(JitterCase{2.1, 0.05, 0.036}, JitterCase{2.1, 0.1, 0.075},
                                         JitterCase{2.1, 0.2, 0.169}, JitterCase{3.1, 0.05, 0.021},
                                         JitterCase{3.1, 0.1, 0.045}, JitterCase{3.1, 0.2, 0.097}),
                         [](const auto& each) {
                           return std::to_string(std::lround(10 * each.param.radius)) + "_" +
                                  std::to_string(std::lround(100 * each.param.jitter));
                         });

TEST_P(JitteredGradient, misses_a_linear_field_by_as_much_as_known) {
  const auto [radius, jitter, error] = GetParam();
  const test::Cloud<2> cloud = disordered(jitter, radius);
  const Stencils<2> stencils = mps_stencils(mps_kernel<2>(1, radius, radius), LaplacianScale::local,
                                            cloud.positions, cloud.box, cloud.table);
  std::vector<double> field;
  for (const Vector<2>& x : cloud.positions) field.push_back(x[0]);
  std::vector<Vector<2>> gradient;
  apply_gradient(stencils, cloud.table, field, gradient);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (!is_inner(cloud.positions[i])) continue;
    sum += (gradient[i] - Vector<2>(1, 0)).squaredNorm();
    ++count;
  }
  EXPECT_NEAR(std::sqrt(sum / count), error, 0.1 * error);
}

template <int dim>
class CorrectedGradient : public testing::Test {};

template <int dim>
void expect_exact_gradient() {
  const PeriodicBox<dim> box = {.lower = Vector<dim>::Zero(),
                                .upper = Vector<dim>::Constant(dim == 2 ? 30 : 10)};
  test::Cloud<dim> cloud = test::lattice_cloud<dim>(box, 1, 0.3);
  cloud.search(2.1);
  std::vector<Vector<dim>> weights;
  gradient_weights(mps_kernel<dim>(1, 2.1, 2.1), cloud.pairs, cloud.table, weights);
  EXPECT_EQ(correct_gradient(cloud.pairs, cloud.table, 1e6, {}, weights), 0u);
  Vector<dim> slope;
  slope[0] = 2;
  slope[1] = -3;
  if constexpr (dim == 3) slope[2] = 0.5;
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    Vector<dim> gradient = Vector<dim>::Zero();
    for (std::size_t k = cloud.table.begin(i); k < cloud.table.end(i); ++k) {
      gradient += slope.dot(cloud.positions[cloud.table[k]] - cloud.positions[i]) * weights[k];
    }
    ASSERT_LT((gradient - slope).norm(), 1e-12) << i;
  }
}

TEST(CorrectedGradient, is_exact_for_linear_fields_on_disorder_up_to_the_edges) {
  expect_exact_gradient<2>();
  expect_exact_gradient<3>();
}

TEST(CorrectedGradient, leaves_particles_in_a_line_alone_and_counts_them) {
  test::Cloud<2> cloud;
  cloud.positions = {{0, 0}, {1, 0}, {2, 0}};
  cloud.search(1.5);
  std::vector<Vector<2>> weights;
  gradient_weights(mps_kernel<2>(1, 1.5, 1.5), cloud.pairs, cloud.table, weights);
  const std::vector<Vector<2>> plain = weights;
  EXPECT_EQ(correct_gradient(cloud.pairs, cloud.table, 100.0, {}, weights), 3u);
  EXPECT_EQ(weights, plain);
}

TEST(Laplacian, with_the_local_scale_is_exact_for_r_squared_on_disorder) {
  // lambda is defined by it: lap |r - r_i|^2 = 2 d at r_i.
  const test::Cloud<2> cloud = disordered(0.3, 3.1);
  const MpsKernel kernel = mps_kernel<2>(1, 2.1, 3.1);
  LaplacianWeights laplacian;
  laplacian_weights(kernel, LaplacianScale::local, cloud.pairs, cloud.table, laplacian);
  std::vector<double> density;
  number_density(mps_kernel<2>(1, 3.1, 3.1), cloud.pairs, cloud.table, density);
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    double sum = 0;
    for (std::size_t k = cloud.table.begin(i); k < cloud.table.end(i); ++k) {
      sum += laplacian.weights[k] * cloud.pairs.separations[k].squaredNorm();
    }
    // n0 stands in the denominator instead of the own density.
    ASSERT_NEAR(laplacian.factors[i] * sum, 4 * density[i] / kernel.laplacian_density, 1e-12);
  }
}

TEST(DensityRate, is_the_derivative_of_the_density_as_particles_move) {
  test::Cloud<2> cloud = disordered(0.2);
  const MpsKernel kernel = mps_kernel<2>(1, 2.1, 2.1);
  std::vector<Vector<2>> velocities;
  for (const Vector<2>& x : cloud.positions) {
    velocities.emplace_back(std::sin(0.3 * x[1]) + 0.1 * x[0], std::cos(0.2 * x[0]));
  }
  std::vector<double> rate, before, after;
  density_rate(kernel, cloud.pairs, cloud.table, velocities, rate);
  const double dt = 1e-6;
  const std::vector<Vector<2>> middle = cloud.positions;
  const auto density_at = [&](double t, std::vector<double>& density) {
    for (std::size_t i = 0; i < middle.size(); ++i) {
      cloud.positions[i] = middle[i] + t * velocities[i];
    }
    measure_pairs(cloud.positions, cloud.box, cloud.table, cloud.pairs);
    number_density(kernel, cloud.pairs, cloud.table, density);
  };
  density_at(-dt, before);
  density_at(dt, after);
  for (std::size_t i = 0; i < rate.size(); ++i) {
    if (!is_inner(middle[i])) continue;
    ASSERT_NEAR((after[i] - before[i]) / (2 * dt), rate[i], 1e-4) << i;
  }
}

std::vector<Vector<2>> pressure_gradient_of(const test::Cloud<2>& cloud, GradientForm form,
                                            const std::vector<double>& pressures) {
  std::vector<Vector<2>> weights, result;
  std::vector<double> lowest;
  gradient_weights(mps_kernel<2>(1, 2.1, 2.1), cloud.pairs, cloud.table, weights);
  apply_pressure_gradient(form, weights, cloud.table, pressures, lowest, result);
  return result;
}

std::vector<double> slope_of(const test::Cloud<2>& cloud) {
  std::vector<double> pressures;
  for (const Vector<2>& x : cloud.positions) pressures.push_back(3 * x[0] - x[1]);
  return pressures;
}

TEST(PressureGradient, as_printed_and_with_the_minimum_is_exact_for_a_linear_field_on_a_lattice) {
  const test::Cloud<2> cloud = disordered(0);
  for (const GradientForm form : {GradientForm::difference, GradientForm::minimum}) {
    const std::vector<Vector<2>> gradient = pressure_gradient_of(cloud, form, slope_of(cloud));
    for (std::size_t i = 0; i < gradient.size(); ++i) {
      if (!is_inner(cloud.positions[i])) continue;
      ASSERT_LT((gradient[i] - Vector<2>(3, -1)).norm(), 1e-11) << static_cast<int>(form);
    }
  }
}

// A documented failure of the published form: p - min p is the same everywhere.
TEST(PressureGradient, antisymmetric_misses_a_linear_field_on_a_lattice_altogether) {
  const test::Cloud<2> cloud = disordered(0);
  const std::vector<Vector<2>> gradient =
      pressure_gradient_of(cloud, GradientForm::antisymmetric, slope_of(cloud));
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    if (!is_inner(cloud.positions[i])) continue;
    ASSERT_LT(gradient[i].norm(), 1e-11);
  }
}

std::vector<double> rough(std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(normal({7, 0, i}));
  return values;
}

TEST(PressureGradient, the_antisymmetric_form_conserves_momentum_and_the_others_do_not) {
  const test::Cloud<2> cloud = disordered(0.2);
  const std::vector<double> pressures = rough(cloud.positions.size());
  const auto total = [&](GradientForm form) {
    Vector<2> sum = Vector<2>::Zero();
    for (const Vector<2>& g : pressure_gradient_of(cloud, form, pressures)) sum += g;
    return sum.norm();
  };
  EXPECT_LT(total(GradientForm::antisymmetric), 1e-10);
  EXPECT_GT(total(GradientForm::difference), 1);
  EXPECT_GT(total(GradientForm::minimum), 1);
}

TEST(PressureGradient, every_pair_repels_in_the_minimum_form_and_not_as_printed) {
  test::Cloud<2> pair;
  pair.positions = {{0, 0}, {1, 0}};
  pair.search(2.1);
  // The force on the first particle is minus the gradient; the second lies on its right.
  EXPECT_EQ(pressure_gradient_of(pair, GradientForm::minimum, {2, 1})[0][0], 0);
  EXPECT_GT(pressure_gradient_of(pair, GradientForm::minimum, {1, 2})[0][0], 0);
  EXPECT_LT(pressure_gradient_of(pair, GradientForm::difference, {2, 1})[0][0], 0);
}

TEST(Shifting, rests_on_a_lattice_and_evens_out_disorder) {
  const PeriodicBox<2> box = {.lower = {0, 0}, .upper = {20, 20}, .periodic = {true, true}};
  const MpsKernel kernel = mps_kernel<2>(1, 2.1, 2.1);
  const auto spread = [&](const test::Cloud<2>& cloud) {
    std::vector<double> density;
    number_density(kernel, cloud.pairs, cloud.table, density);
    double sum = 0;
    for (const double n : density) sum += std::pow(n / kernel.gradient_density - 1, 2);
    return std::sqrt(sum / static_cast<double>(density.size()));
  };
  for (const double jitter : {0.0, 0.2}) {
    test::Cloud<2> cloud = test::lattice_cloud<2>(box, 1, jitter);
    cloud.search(2.1);
    const double before = spread(cloud);
    std::vector<Vector<2>> displacements;
    const std::vector<ParticleKind> kinds(cloud.positions.size(), ParticleKind::fluid);
    for (int round = 0; round < 10; ++round) {
      shift_displacements(kernel, ShiftKind::ops, 0.3, cloud.pairs, cloud.table, kinds,
                          displacements);
      for (std::size_t i = 0; i < kinds.size(); ++i) cloud.positions[i] += displacements[i];
      cloud.search(2.1);
    }
    if (jitter == 0) {
      EXPECT_LT(spread(cloud), 1e-13);
    } else {
      EXPECT_LT(spread(cloud), 0.5 * before);
    }
  }
}

TEST(Shifting, does_not_move_a_flat_surface_across_itself) {
  test::Cloud<2> cloud =
      test::lattice_cloud<2>({.lower = {0, 0}, .upper = {20, 8}, .periodic = {true, false}}, 1, 0);
  cloud.search(2.1);
  std::vector<ParticleKind> kinds;
  for (const Vector<2>& x : cloud.positions) {
    kinds.push_back(x.y() > 7 || x.y() < 1 ? ParticleKind::surface : ParticleKind::fluid);
  }
  const MpsKernel kernel = mps_kernel<2>(1, 2.1, 2.1);
  std::vector<Vector<2>> along, free;
  shift_displacements(kernel, ShiftKind::ops, 0.3, cloud.pairs, cloud.table, kinds, along);
  for (const Vector<2>& d : along) EXPECT_LT(d.norm(), 1e-12);
  // Without the surface being known, its row is driven out.
  kinds.assign(kinds.size(), ParticleKind::fluid);
  shift_displacements(kernel, ShiftKind::concentration, 0.3, cloud.pairs, cloud.table, kinds, free);
  EXPECT_GT(free.back().y(), 0.05);
}

TEST(Follow, to_second_order_is_exact_for_a_quadratic_field_within) {
  test::Cloud<2> cloud = disordered(0);
  std::vector<Vector<2>> weights;
  gradient_weights(mps_kernel<2>(1, 2.1, 2.1), cloud.pairs, cloud.table, weights);
  correct_gradient(cloud.pairs, cloud.table, 100.0, {}, weights);
  const auto value = [](const Vector<2>& x) { return 1 + x[0] - x[1] * x[0] + 0.3 * x[1] * x[1]; };
  std::vector<double> field;
  for (const Vector<2>& x : cloud.positions) field.push_back(value(x));
  const std::vector<Vector<2>> moved(field.size(), Vector<2>(0.07, -0.04));
  std::vector<double> first = field, second = field, none = field;
  follow(ShiftInterpolation::none, weights, cloud.table, moved, none);
  follow(ShiftInterpolation::first_order, weights, cloud.table, moved, first);
  follow(ShiftInterpolation::second_order, weights, cloud.table, moved, second);
  EXPECT_EQ(none, field);
  double largest_first = 0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (!is_inner(cloud.positions[i])) continue;
    const double exact = value(cloud.positions[i] + moved[i]);
    ASSERT_NEAR(second[i], exact, 1e-10);
    largest_first = std::max(largest_first, std::abs(first[i] - exact));
  }
  EXPECT_NEAR(largest_first, std::abs(0.07 * 0.04 + 0.3 * 0.04 * 0.04), 1e-10);
}

}  // namespace
}  // namespace hemoscale::micro
