#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "micro/error.hpp"
#include "micro/mps/free_surface.hpp"
#include "micro/mps/mps_operators.hpp"
#include "micro/mps/number_density.hpp"
#include "micro/mps/reference_density.hpp"
#include "tests/support/mps/lattices.hpp"

namespace hemoscale::micro {
namespace {

struct Constants {
  double radius;
  int neighbours;
  double density, second_moment, eigenvalue, limit, surface, one_row;
};

class LatticeConstants : public testing::TestWithParam<Constants> {};

// Direct sums over the lattice, computed independently of this code.
INSTANTIATE_TEST_SUITE_P(
    , LatticeConstants,
    testing::Values(Constants{2.1, 12, 6.539697, 1.388351, 3.8877, 0.5144, 0.6758, 0.9924},
                    Constants{2.5, 20, 11.015340, 1.894040, 2.6627, 0.7511, 0.6589, 0.9559},
                    Constants{3.1, 28, 18.976417, 2.448472, 2.0015, 0.9993, 0.6414, 0.9184},
                    Constants{4.0, 44, 35.609223, 3.707100, 1.2435, 1.6083, 0.6217, 0.8678},
                    Constants{4.1, 48, 37.699453, 3.843746, 1.1943, 1.6747, 0.6205, 0.8634}),
    [](const auto& each) {
      return "radius_" + std::to_string(static_cast<int>(std::lround(10 * each.param.radius)));
    });

TEST_P(LatticeConstants, sums) {
  const Constants& expected = GetParam();
  const ReferenceDensity sums = reference_density<2>(expected.radius);
  EXPECT_EQ(sums.neighbours, expected.neighbours);
  EXPECT_NEAR(sums.density, expected.density, 1e-5);
  EXPECT_NEAR(sums.second_moment, expected.second_moment, 1e-5);
}

TEST_P(LatticeConstants, largest_eigenvalue) {
  const Constants& expected = GetParam();
  const double eigenvalue = largest_laplacian_eigenvalue<2>(expected.radius);
  EXPECT_NEAR(eigenvalue, expected.eigenvalue, 6e-5);  // of four digits
  EXPECT_NEAR(2 / eigenvalue, expected.limit, 1e-4);
}

/// n / n0 of the outermost row of a half plane of rows.
double density_at_edge(double radius, int rows_behind) {
  test::Cloud<2> cloud = test::lattice_cloud<2>(
      {.lower = {0, -1.0 * rows_behind}, .upper = {20, 10}, .periodic = {true, false}}, 1, 0);
  const MpsKernel kernel = mps_kernel<2>(1, radius, radius);
  cloud.search(radius);
  std::vector<double> density;
  number_density(kernel, cloud.pairs, cloud.table, density);
  for (std::size_t i = 0; i < density.size(); ++i) {
    if (std::abs(cloud.positions[i].y() - 0.5) < 0.1) return density[i] / kernel.gradient_density;
  }
  return 0;
}

TEST_P(LatticeConstants, density_at_a_free_surface) {
  EXPECT_NEAR(density_at_edge(GetParam().radius, 0), GetParam().surface, 6e-5);
}

TEST_P(LatticeConstants, density_with_a_single_row_behind) {
  EXPECT_NEAR(density_at_edge(GetParam().radius, 1), GetParam().one_row, 6e-5);
}

TEST(ReferenceDensity, in_three_dimensions_counts_the_cube) {
  // Within 1.5: six faces at 1, twelve edges at sqrt 2.
  const ReferenceDensity sums = reference_density<3>(1.5);
  EXPECT_EQ(sums.neighbours, 18);
  const double edge = 1.5 / std::numbers::sqrt2 - 1;
  EXPECT_NEAR(sums.density, 6 * 0.5 + 12 * edge, 1e-14);
  EXPECT_NEAR(sums.second_moment, (6 * 0.5 + 12 * 2 * edge) / sums.density, 1e-14);
}

TEST(ReferenceDensity, refuses_a_radius_without_neighbours) {
  EXPECT_THROW(reference_density<2>(1), ParameterError);
  EXPECT_THROW(reference_density<2>(std::nan("")), ParameterError);
}

TEST(FreeSurface, is_what_lies_below_the_ratio) {
  std::vector<ParticleKind> kinds = {ParticleKind::fluid, ParticleKind::fluid,
                                     ParticleKind::surface, ParticleKind::wall};
  std::vector<char> is_dry;
  EXPECT_EQ(detect_free_surface({9.8, 9.6, 9.8, 1}, 10, 0.97, kinds, is_dry), 1u);
  EXPECT_EQ(is_dry, (std::vector<char>{0, 1, 0, 1}));
  EXPECT_EQ(kinds, (std::vector<ParticleKind>{ParticleKind::fluid, ParticleKind::surface,
                                              ParticleKind::fluid, ParticleKind::wall}));
}

struct DecayRatio {
  int per_wavelength;
  double radius, ratio;
};

class FrozenTaylorGreen : public testing::TestWithParam<DecayRatio> {};

INSTANTIATE_TEST_SUITE_P(, FrozenTaylorGreen,
                         testing::Values(DecayRatio{10, 2.1, 0.9199}, DecayRatio{20, 2.1, 0.9793},
                                         DecayRatio{32, 2.1, 0.9919}, DecayRatio{64, 2.1, 0.9980},
                                         DecayRatio{10, 3.1, 0.8300}, DecayRatio{20, 3.1, 0.9538},
                                         DecayRatio{32, 3.1, 0.9816}, DecayRatio{64, 3.1, 0.9954},
                                         DecayRatio{10, 4.0, 0.7356}, DecayRatio{20, 4.0, 0.9242},
                                         DecayRatio{32, 4.0, 0.9695}, DecayRatio{64, 4.0, 0.9923}),
                         [](const auto& each) {
                           return std::to_string(each.param.per_wavelength) + "_" +
                                  std::to_string(
                                      static_cast<int>(std::lround(10 * each.param.radius)));
                         });

// The field is an eigenvector of the Laplacian on the lattice.
TEST_P(FrozenTaylorGreen, decays_at_the_rate_of_the_lattice) {
  const auto [n, radius, ratio] = GetParam();
  const double length = n;
  test::Cloud<2> cloud = test::lattice_cloud<2>(
      {.lower = {0, 0}, .upper = {length, length}, .periodic = {true, true}}, 1, 0);
  cloud.search(radius);
  const Stencils<2> stencils = mps_stencils(mps_kernel<2>(1, radius, radius), LaplacianScale::local,
                                            cloud.positions, cloud.box, cloud.table);
  const double k = 2 * std::numbers::pi / length;
  std::vector<double> u;
  for (const Vector<2>& x : cloud.positions) u.push_back(std::sin(k * x[0]) * std::cos(k * x[1]));
  std::vector<double> laplacian;
  apply_laplacian(stencils, cloud.table, u, laplacian);
  for (std::size_t i = 0; i < u.size(); ++i) {
    ASSERT_NEAR(laplacian[i], -2 * k * k * ratio * u[i], 2 * k * k * 1e-3);
  }
}

}  // namespace
}  // namespace hemoscale::micro
