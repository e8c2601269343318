#include "micro/linear/lattice_interpolation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "micro/linear/galerkin.hpp"
#include "tests/support/linear/model_systems.hpp"

namespace hemoscale::micro {
namespace {

template <int dim>
std::vector<Vector<dim>> scattered(std::size_t count, std::uint64_t seed) {
  const std::vector<double> values = random_vector(count * dim, seed);
  std::vector<Vector<dim>> positions(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (int a = 0; a < dim; ++a) {
      positions[i][a] = 10 + 10 * values[i * dim + static_cast<std::size_t>(a)];
    }
  }
  return positions;
}

template <int dim>
std::vector<bool> all(const std::vector<Vector<dim>>& positions) {
  return std::vector<bool>(positions.size(), true);
}

// Values at the fine nodes of a function given at the coarse ones.
template <int dim, class Function>
std::vector<double> interpolate(const CoarseLattice<dim>& coarse, const Function& function) {
  const Interpolation& p = coarse.interpolation;
  std::vector<double> values(p.fine_size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (auto k = static_cast<std::size_t>(p.first[i]);
         k < static_cast<std::size_t>(p.first[i + 1]); ++k) {
      values[i] += static_cast<double>(p.weight[k]) *
                   function(coarse.positions[static_cast<std::size_t>(p.coarse[k])]);
    }
  }
  return values;
}

template <int dim>
void expect_constants_exact(const CoarseLattice<dim>& coarse) {
  for (const double value : interpolate(coarse, [](const Vector<dim>&) { return 1.0; })) {
    EXPECT_EQ(value, 1.0);
  }
}

TEST(LatticeInterpolation, hats_sum_to_one_exactly_in_two_and_three_dimensions) {
  const auto plane = scattered<2>(500, 1);
  expect_constants_exact(lay_lattice<2>({plane, 1, {0, 0}, 0}, 3.3, all(plane)));
  const auto space = scattered<3>(500, 2);
  expect_constants_exact(lay_lattice<3>({space, 1, {0, 0, 0}, 0}, 3.3, all(space)));
}

TEST(LatticeInterpolation, hats_sum_to_one_in_joined_and_in_sheared_boxes) {
  const auto plane = scattered<2>(500, 1);
  expect_constants_exact(lay_lattice<2>({plane, 1, {20, 0}, 0}, 3.3, all(plane)));
  expect_constants_exact(lay_lattice<2>({plane, 1, {20, 20}, 7.3}, 3.3, all(plane)));
  // So narrow that the two neighbours of a node are one and the same lattice node.
  expect_constants_exact(lay_lattice<2>({plane, 1, {20, 20}, 7.3}, 30, all(plane)));
}

TEST(LatticeInterpolation, linear_fields_are_exact_up_to_the_rounding_of_places) {
  const auto positions = scattered<2>(500, 3);
  const auto field = [](const Vector<2>& x) { return 2 * x[0] - 3 * x[1]; };
  const auto coarse = lay_lattice<2>({positions, 1, {0, 0}, 0}, 4, all(positions));
  const std::vector<double> values = interpolate(coarse, field);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    EXPECT_NEAR(values[i], field(positions[i]), 0.06 * 4 * 5);  // places are snapped by 0.05 h
  }
}

TEST(LatticeInterpolation, crosses_the_faces_of_a_sheared_box_with_the_slide) {
  // A field of the sheared box: f(x + 8, y) = f(x, y) and f(x + slide, y + 8) = f(x, y).
  const double slide = 3;
  const auto field = [&](const Vector<2>& x) {
    return std::sin(2 * std::numbers::pi * (x[0] - slide * x[1] / 8) / 8);
  };
  std::vector<Vector<2>> positions;
  for (const Vector<2>& x : scattered<2>(2000, 5)) {
    positions.push_back(x * 0.8 - Vector<2>(4, 4));  // reaches beyond the box [0, 8) on all sides
  }
  const auto coarse = lay_lattice<2>({positions, 0.2, {8, 8}, slide}, 0.25, all(positions));
  const std::vector<double> values = interpolate(coarse, field);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    EXPECT_NEAR(values[i], field(positions[i]), 0.03) << positions[i].transpose();
  }
}

TEST(LatticeInterpolation, both_forms_hold_the_same_weights) {
  const auto positions = scattered<2>(200, 4);
  const Interpolation p =
      lay_lattice<2>({positions, 1, {0, 0}, 0}, 3, all(positions)).interpolation;
  std::vector<std::vector<double>> rows(p.fine_size(), std::vector<double>(p.coarse_size()));
  auto columns = rows;
  for (std::size_t i = 0; i < p.fine_size(); ++i) {
    for (auto k = static_cast<std::size_t>(p.first[i]);
         k < static_cast<std::size_t>(p.first[i + 1]); ++k) {
      rows[i][static_cast<std::size_t>(p.coarse[k])] += static_cast<double>(p.weight[k]);
    }
  }
  for (std::size_t j = 0; j < p.coarse_size(); ++j) {
    for (auto k = static_cast<std::size_t>(p.coarse_first[j]);
         k < static_cast<std::size_t>(p.coarse_first[j + 1]); ++k) {
      columns[static_cast<std::size_t>(p.fine[k])][j] += static_cast<double>(p.coarse_weight[k]);
    }
  }
  EXPECT_EQ(rows, columns);
}

TEST(LatticeInterpolation, leaves_out_inactive_nodes_and_unused_lattice_nodes) {
  const std::vector<Vector<2>> positions = {{0, 0}, {1, 0}, {30, 0}};
  const auto coarse = lay_lattice<2>({positions, 1, {0, 0}, 0}, 3, {true, false, true});
  EXPECT_EQ(coarse.positions.size(), 2U);  // below the first and the last
  const Interpolation& p = coarse.interpolation;
  EXPECT_THAT(p.first, testing::ElementsAre(0, 1, 1, 2));
}

TEST(Galerkin, is_the_product_of_the_three_matrices) {
  const auto positions = scattered<2>(60, 6);
  const SparseMatrix a = random_matrix(60, 4, false, 0, 7);
  const Interpolation p =
      lay_lattice<2>({positions, 1, {0, 0}, 0}, 6, all(positions)).interpolation;
  std::vector<double> rows = random_vector(60, 8);
  Eigen::MatrixXd fine = Eigen::MatrixXd::Zero(60, 60);
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(60, static_cast<int>(p.coarse_size()));
  for (int i = 0; i < 60; ++i) {
    const auto row = static_cast<std::size_t>(i);
    for (auto k = static_cast<std::size_t>(a.pattern->first[row]);
         k < static_cast<std::size_t>(a.pattern->first[row + 1]); ++k) {
      fine(i, a.pattern->columns[k]) = rows[row] * a.values[k];
    }
    for (auto k = static_cast<std::size_t>(p.first[row]);
         k < static_cast<std::size_t>(p.first[row + 1]); ++k) {
      weights(i, p.coarse[k]) = static_cast<double>(p.weight[k]);
    }
  }
  const Eigen::MatrixXd expected = weights.transpose() * fine * weights;
  const SparseMatrix product = galerkin_product(a, rows, p);
  Eigen::MatrixXd found = Eigen::MatrixXd::Zero(expected.rows(), expected.cols());
  for (std::size_t i = 0; i < product.rows(); ++i) {
    for (auto k = static_cast<std::size_t>(product.pattern->first[i]);
         k < static_cast<std::size_t>(product.pattern->first[i + 1]); ++k) {
      found(static_cast<int>(i), product.pattern->columns[k]) = product.values[k];
    }
  }
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-14);
}

}  // namespace
}  // namespace hemoscale::micro
