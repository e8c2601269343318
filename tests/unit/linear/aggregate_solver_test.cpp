#include "micro/linear/aggregate_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "micro/error.hpp"
#include "tests/support/linear/model_systems.hpp"

namespace hemoscale::micro {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(AggregateSolver, starts_from_the_guess) {
  const auto system = particle_laplacian<2>({60, 20}, ChannelEnds::outlet, 0.2, 1);
  AggregateSolver<2> solver(system.layout(), true);
  solver.prepare(system.matrix);
  const std::vector<double> b = random_vector(system.matrix.rows(), 1);
  std::vector<double> x(b.size());
  EXPECT_GT(solver.solve(b, x).iterations, 3);
  EXPECT_EQ(solver.solve(b, x).iterations, 0);
  EXPECT_LE(relative_residual(system.matrix, x, b), 1e-10);
}

TEST(AggregateSolver, solves_negative_definite_systems) {
  auto system = particle_laplacian<2>({60, 20}, ChannelEnds::outlet, 0.2, 1);
  for (double& value : system.matrix.values) value = -value;
  AggregateSolver<2> solver(system.layout(), true);
  solver.prepare(system.matrix);
  const std::vector<double> b = random_vector(system.matrix.rows(), 1);
  std::vector<double> x(b.size());
  EXPECT_LT(solver.solve(b, x).iterations, 12);
  EXPECT_LE(relative_residual(system.matrix, x, b), 1e-10);
}

TEST(AggregateSolver, does_not_mind_units) {
  auto system = particle_laplacian<2>({60, 20}, ChannelEnds::outlet, 0.2, 1);
  std::vector<double> b = random_vector(system.matrix.rows(), 1);
  for (double& value : system.matrix.values) value *= 1e40;  // beyond single precision
  for (double& value : b) value *= 1e-80;
  for (const bool symmetric : {true, false}) {
    AggregateSolver<2> solver(system.layout(), symmetric);
    solver.prepare(system.matrix);
    std::vector<double> x(b.size());
    EXPECT_LT(solver.solve(b, x).iterations, 12);
    EXPECT_LE(relative_residual(system.matrix, x, b), 1e-10);
  }
}

TEST(AggregateSolver, gives_zero_for_zero) {
  const auto system = particle_laplacian<2>({30, 10}, ChannelEnds::outlet, 0.2, 1);
  AggregateSolver<2> solver(system.layout(), true);
  solver.prepare(system.matrix);
  std::vector<double> x(system.matrix.rows(), 1.0);
  solver.solve(std::vector<double>(x.size()), x);
  EXPECT_THAT(x, testing::Each(0));
}

TEST(AggregateSolver, solves_rows_that_all_stand_alone) {
  const std::vector<Vector<2>> positions = {{0, 0}, {1, 0}, {2, 0}};
  const SparseMatrix a = sparse({{1, 0, 0}, {0, 2, 0}, {0, 0, 4}});
  AggregateSolver<2> solver({positions, 1, {0, 0}, 0}, true);
  solver.prepare(a);
  std::vector<double> x(3);
  solver.solve(std::vector<double>({1, 4, 12}), x);
  EXPECT_THAT(x, testing::Pointwise(testing::DoubleNear(1e-9), {1.0, 2.0, 3.0}));
}

TEST(AggregateSolver, nodes_on_a_line_and_a_single_node_are_no_exception) {
  const auto line = particle_laplacian<2>({200, 1}, ChannelEnds::outlet, 0, 1);
  AggregateSolver<2> solver(line.layout(), true);
  solver.prepare(line.matrix);
  const std::vector<double> b = random_vector(200 - 1, 1);
  std::vector<double> x(b.size());
  EXPECT_LT(solver.solve(b, x).iterations, 20);
  EXPECT_LE(relative_residual(line.matrix, x, b), 1e-10);

  const std::vector<Vector<2>> positions = {{0, 0}};
  AggregateSolver<2> single({positions, 1, {0, 0}, 0}, false);
  single.prepare(sparse({{-2}}));
  std::vector<double> y(1);
  single.solve(std::vector<double>({4}), y);
  EXPECT_NEAR(y[0], -2, 1e-9);
}

TEST(AggregateSolver, names_a_diagonal_entry_that_it_cannot_use) {
  const std::vector<Vector<2>> positions = {{0, 0}, {1, 0}};
  AggregateSolver<2> symmetric({positions, 1, {0, 0}, 0}, true);
  EXPECT_THAT(
      [&] {
        symmetric.prepare(sparse({{1, 0}, {0, -3}}));
      },
      ThrowsMessage<NumericalError>(HasSubstr("diagonal entry 1 is -3")));
  AggregateSolver<2> general({positions, 1, {0, 0}, 0}, false);
  EXPECT_THAT(
      [&] {
        general.prepare(sparse({{0, 1}, {1, 1}}));
      },
      ThrowsMessage<NumericalError>(HasSubstr("diagonal entry 0 is 0")));
  EXPECT_THAT(
      [&] {
        general.prepare(sparse({{1, std::nan("")}, {1, 1}}));
      },
      ThrowsMessage<NumericalError>(HasSubstr("entry (0, 1) is nan")));
}

TEST(AggregateSolver, reports_that_it_does_not_converge) {
  const auto system = particle_laplacian<2>({60, 20}, ChannelEnds::outlet, 0.2, 1);
  const std::vector<double> b = random_vector(system.matrix.rows(), 1);
  for (const bool symmetric : {true, false}) {
    AggregateSolver<2> solver(system.layout(), symmetric, {1e-10, 2});
    solver.prepare(system.matrix);
    std::vector<double> x(b.size());
    EXPECT_THAT([&] { solver.solve(b, x); },
                ThrowsMessage<NumericalError>(HasSubstr("2 of at most 2 iterations")));
  }
}

TEST(AggregateSolver, refuses_what_does_not_fit) {
  const std::vector<Vector<2>> positions = {{0, 0}, {1, 0}};
  EXPECT_THROW(AggregateSolver<2>({positions, 0, {0, 0}, 0}, true), ParameterError);
  AggregateSolver<2> solver({positions, 1, {0, 0}, 0}, true);
  EXPECT_THROW(solver.prepare(sparse({{1}})), ParameterError);
  std::vector<double> x(2);
  EXPECT_THROW(solver.solve(x, x), ParameterError);  // nothing prepared
  const std::vector<Vector<2>> lost = {{0, 0}, {std::nan(""), 0}};
  EXPECT_THROW(AggregateSolver<2>({lost, 1, {0, 0}, 0}, true), NumericalError);
}

}  // namespace
}  // namespace hemoscale::micro
