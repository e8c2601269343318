#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "micro/error.hpp"
#include "micro/linear/banded_solver.hpp"
#include "micro/linear/sparse_direct_solver.hpp"
#include "tests/support/linear/model_systems.hpp"

namespace hemoscale::micro {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

enum class Kind { banded_lu, banded_cholesky, sparse_lu, sparse_ldlt };

bool is_symmetric(Kind kind) {
  return kind == Kind::banded_cholesky || kind == Kind::sparse_ldlt;
}

std::unique_ptr<LinearSolver> make(Kind kind, const SparseMatrix& matrix,
                                   std::optional<ConstantNullSpace> null_space = {},
                                   const SolveTolerance& tolerance = {}) {
  if (kind == Kind::banded_lu || kind == Kind::banded_cholesky) {
    return std::make_unique<BandedSolver>(natural_order(*matrix.pattern), tolerance, null_space,
                                          is_symmetric(kind));
  }
  return std::make_unique<SparseDirectSolver>(is_symmetric(kind), tolerance, null_space);
}

class DirectSolvers : public testing::TestWithParam<Kind> {
 protected:
  std::vector<double> solve(const SparseMatrix& a, const std::vector<double>& b,
                            std::optional<ConstantNullSpace> null_space = {},
                            const SolveTolerance& tolerance = {}) {
    const auto solver = make(GetParam(), a, null_space, tolerance);
    solver->prepare(a);
    std::vector<double> x(b.size(), 7.0);  // the guess is ignored
    report_ = solver->solve(b, x);
    return x;
  }

  SolveReport report_;
};

INSTANTIATE_TEST_SUITE_P(All, DirectSolvers,
                         testing::Values(Kind::banded_lu, Kind::banded_cholesky, Kind::sparse_lu,
                                         Kind::sparse_ldlt));

TEST_P(DirectSolvers, solve_a_system_known_by_hand) {
  const SparseMatrix a = sparse({{4, -1, 0}, {-1, 4, -2}, {0, -2, 5}});
  const std::vector<double> x = solve(a, {2, 1, 11});
  EXPECT_THAT(x, testing::Pointwise(testing::DoubleNear(1e-14), {1.0, 2.0, 3.0}));
  EXPECT_EQ(report_.iterations, 0);
  EXPECT_LT(report_.relative_residual, 1e-14);
}

TEST_P(DirectSolvers, solve_negative_definite_systems) {
  const SparseMatrix a = sparse({{-4, 1, 0}, {1, -4, 2}, {0, 2, -5}});
  EXPECT_THAT(solve(a, {-2, -1, -11}),
              testing::Pointwise(testing::DoubleNear(1e-14), {1.0, 2.0, 3.0}));
}

TEST_P(DirectSolvers, give_zero_for_zero) {
  EXPECT_THAT(solve(sparse({{4, -1}, {-1, 4}}), {0, 0}), testing::ElementsAre(0, 0));
}

TEST_P(DirectSolvers, do_not_mind_units) {
  // The first system with unknowns and equations measured in other units.
  const double u = 1e-9;
  const SparseMatrix a = sparse({{4, -1 * u, 0}, {-1 * u, 4 * u * u, -2 * u}, {0, -2 * u, 5}});
  const std::vector<double> x = solve(a, {2, 1 * u, 11});
  EXPECT_NEAR(x[0], 1, 1e-14);
  EXPECT_NEAR(x[1], 2 / u, 1e-14 / u);
  EXPECT_NEAR(x[2], 3, 1e-14);
}

TEST_P(DirectSolvers, take_new_values_on_the_pattern) {
  SparseMatrix a = sparse({{4, -1}, {-1, 4}});
  const auto solver = make(GetParam(), a);
  std::vector<double> x(2);
  solver->prepare(a);
  solver->solve(std::vector<double>({2, 7}), x);
  EXPECT_THAT(x, testing::Pointwise(testing::DoubleNear(1e-14), {1.0, 2.0}));
  for (double& value : a.values) value *= 2;
  solver->prepare(a);
  solver->solve(std::vector<double>({2, 7}), x);
  EXPECT_THAT(x, testing::Pointwise(testing::DoubleNear(1e-14), {0.5, 1.0}));
}

TEST_P(DirectSolvers, do_not_need_the_matrix_after_prepare) {
  SparseMatrix a = sparse({{4, -1}, {-1, 4}});
  const auto solver = make(GetParam(), a);
  solver->prepare(a);
  for (double& value : a.values) value = 1;
  std::vector<double> x(2);
  solver->solve(std::vector<double>({2, 7}), x);
  EXPECT_THAT(x, testing::Pointwise(testing::DoubleNear(1e-14), {1.0, 2.0}));
}

TEST_P(DirectSolvers, refuse_a_singular_matrix) {
  // Neumann conditions everywhere; exact in binary, so that a pivot is exactly zero.
  const SparseMatrix a = sparse({{1, -1, 0}, {-1, 2, -1}, {0, -1, 1}});
  const auto solver = make(GetParam(), a);
  std::vector<double> x(3);
  EXPECT_THROW(
      {
        solver->prepare(a);
        solver->solve(std::vector<double>({1, 0, 0}), x);
      },
      NumericalError);
}

TEST_P(DirectSolvers, refuse_an_empty_row) {
  const SparseMatrix a = sparse({{1, 0}, {0, 0}});
  EXPECT_THAT([&] { make(GetParam(), a)->prepare(a); },
              ThrowsMessage<NumericalError>(HasSubstr("1 is zero")));
}

TEST_P(DirectSolvers, name_an_entry_that_is_not_finite) {
  const SparseMatrix a = sparse({{1, 0}, {std::nan(""), 1}});
  EXPECT_THAT([&] { make(GetParam(), a)->prepare(a); },
              ThrowsMessage<NumericalError>(HasSubstr("entry (1, 0)")));
}

TEST_P(DirectSolvers, name_a_right_hand_side_that_is_not_finite) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(
      [&] {
        solve(sparse({{4, -1}, {-1, 4}}), {1, infinity});
      },
      ThrowsMessage<NumericalError>(HasSubstr("right-hand side: value 1 is inf")));
}

TEST_P(DirectSolvers, refuse_vectors_of_another_size) {
  const SparseMatrix a = sparse({{4, -1}, {-1, 4}});
  const auto solver = make(GetParam(), a);
  std::vector<double> x(2);
  EXPECT_THROW(solver->solve(x, x), ParameterError);  // nothing prepared
  solver->prepare(a);
  EXPECT_THROW(solver->solve(std::vector<double>(3), x), ParameterError);
}

TEST_P(DirectSolvers, report_a_tolerance_below_round_off) {
  // A Hilbert matrix: the residual cannot be exactly zero.
  std::vector<std::vector<double>> hilbert(6, std::vector<double>(6));
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      hilbert[i][j] = 1 / static_cast<double>(i + j + 1);
    }
  }
  EXPECT_THAT(
      [&] {
        solve(sparse(hilbert), {1, -1, 1, -1, 1, -1}, {}, {1e-30, 1});
      },
      ThrowsMessage<NumericalError>(HasSubstr("more than 1e-30")));
}

TEST_P(DirectSolvers, spread_what_cannot_be_reached_and_leave_no_mean) {
  // Differences of three nodes in a row. Of b = (3, 0, 0) the mean 1 cannot be reached; A x =
  // (2, -1, -1) gives x_0 - x_1 = 2, x_1 - x_2 = 1, and without mean x = (5, -1, -4) / 3.
  const SparseMatrix a = sparse({{1, -1, 0}, {-1, 2, -1}, {0, -1, 1}});
  const std::vector<double> x = solve(a, {3, 0, 0}, ConstantNullSpace{});
  EXPECT_THAT(x, testing::Pointwise(testing::DoubleNear(1e-14), {5. / 3, -1. / 3, -4. / 3}));
}

TEST_P(DirectSolvers, refuse_a_null_space_that_is_none) {
  const SparseMatrix a = sparse({{1, -1, 0}, {-1, 2, -1}, {0, -1, 1.001}});
  EXPECT_THAT(
      [&] {
        solve(a, {3, 0, 0}, ConstantNullSpace{});
      },
      ThrowsMessage<NumericalError>(HasSubstr("row 2 maps them to")));
  EXPECT_THROW(solve(a, {3, 0, 0}, ConstantNullSpace{3, 1}), ParameterError);
  EXPECT_THROW(solve(a, {3, 0, 0}, ConstantNullSpace{0, 0}), ParameterError);
}

TEST_P(DirectSolvers, refuse_a_second_null_vector) {
  // Two chains that do not touch: constants on either are null vectors.
  const SparseMatrix a = sparse({{1, -1, 0, 0}, {-1, 1, 0, 0}, {0, 0, 1, -1}, {0, 0, -1, 1}});
  EXPECT_THROW(solve(a, {1, 2, 3, 4}, ConstantNullSpace{}), NumericalError);
}

// Only LU with pivots is for these.
class PivotingSolvers : public DirectSolvers {};
INSTANTIATE_TEST_SUITE_P(All, PivotingSolvers, testing::Values(Kind::banded_lu, Kind::sparse_lu));

TEST_P(PivotingSolvers, solve_indefinite_systems_with_zeros_on_the_diagonal) {
  const SparseMatrix a = sparse({{0, 1, 2}, {1, 0, -1}, {3, 1, 0}});
  EXPECT_THAT(solve(a, {8, -2, 5}),
              testing::Pointwise(testing::DoubleNear(1e-14), {1.0, 2.0, 3.0}));
}

TEST_P(PivotingSolvers, are_not_misled_by_a_row_in_small_units) {
  // Of the first column the upper entry is the larger number, and the smaller part of its row: as
  // pivot it would cost the first unknown twelve digits.
  const SparseMatrix a = sparse({{1.3e3, 1.1e15}, {1, 1}});
  EXPECT_THAT(solve(a, {1.3e3 * 0.3 + 1.1e15 * 0.7, 1}),
              testing::Pointwise(testing::DoubleNear(1e-12), {0.3, 0.7}));
}

TEST_P(PivotingSolvers, leave_the_mean_of_the_described_unknowns_alone_out) {
  // Velocity u and pressure p of two nodes, interleaved; only p_1 - p_0 enters. The continuity of
  // the two nodes, u_1 - u_0 + lambda = 2 and u_0 - u_1 + lambda = 4, needs lambda = 3.
  const SparseMatrix a = sparse({{1, -1, 0, 1}, {-1, 0, 1, 0}, {0, -1, 2, 1}, {1, 0, -1, 0}});
  const std::vector<double> b = {1, 2, 3, 4};
  const std::vector<double> x = solve(a, b, ConstantNullSpace{1, 2});
  EXPECT_NEAR(x[1] + x[3], 0, 1e-14);
  std::vector<double> product(4);
  multiply(a, x, product);
  EXPECT_NEAR(b[0] - product[0], 0, 1e-14);
  EXPECT_NEAR(b[2] - product[2], 0, 1e-14);
  EXPECT_NEAR(b[1] - product[1], 3, 1e-14);  // the same is missing in both rows
  EXPECT_NEAR(b[3] - product[3], 3, 1e-14);
}

TEST(BandedSolver, refuses_entries_outside_the_band_of_its_order) {
  const SparseMatrix narrow = sparse({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const SparseMatrix wide = sparse({{1, 0, 2}, {0, 1, 0}, {0, 0, 1}});
  BandedSolver solver(natural_order(*narrow.pattern));
  EXPECT_THAT([&] { solver.prepare(wide); },
              ThrowsMessage<ParameterError>(HasSubstr("entry (0, 2) lies outside")));
}

TEST(BandedSolver, names_the_unknown_without_a_pivot) {
  const SparseMatrix a = sparse({{2, 0, 0}, {0, 1, 1}, {0, 1, 1}});
  BandedSolver solver(natural_order(*a.pattern));
  EXPECT_THAT([&] { solver.prepare(a); },
              ThrowsMessage<NumericalError>(HasSubstr("no pivot for unknown 2")));
}

TEST(BandedSolver, cholesky_refuses_an_indefinite_matrix) {
  const SparseMatrix a = sparse({{1, 2}, {2, 1}});
  BandedSolver solver(natural_order(*a.pattern), {}, {}, true);
  EXPECT_THAT([&] { solver.prepare(a); }, ThrowsMessage<NumericalError>(HasSubstr("not definite")));
}

}  // namespace
}  // namespace hemoscale::micro
