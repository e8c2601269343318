// Different methods, numberings and threads: one solution.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "micro/linear/aggregate_solver.hpp"
#include "micro/linear/banded_solver.hpp"
#include "micro/linear/ordering.hpp"
#include "micro/linear/sparse_direct_solver.hpp"
#include "tests/support/linear/model_systems.hpp"

namespace hemoscale::micro {
namespace {

constexpr SolveTolerance tight{1e-12, 500};

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double apart = 0;
  double size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    apart = std::max(apart, std::abs(a[i] - b[i]));
    size = std::max(size, std::abs(b[i]));
  }
  return apart / size;
}

std::vector<double> solution(LinearSolver& solver, const SparseMatrix& a,
                             const std::vector<double>& b) {
  solver.prepare(a);
  std::vector<double> x(b.size());
  solver.solve(b, x);
  return x;
}

// The system with its unknowns renumbered; `place` holds the new numbers.
SparseMatrix renumbered(const SparseMatrix& a, const std::vector<std::size_t>& place) {
  std::vector<std::vector<double>> dense(a.rows(), std::vector<double>(a.rows()));
  for (std::size_t i = 0; i < a.rows(); ++i) {
    for (auto k = static_cast<std::size_t>(a.pattern->first[i]);
         k < static_cast<std::size_t>(a.pattern->first[i + 1]); ++k) {
      dense[place[i]][place[static_cast<std::size_t>(a.pattern->columns[k])]] = a.values[k];
    }
  }
  return sparse(dense);
}

class RandomSystems : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, RandomSystems, testing::Range<std::uint64_t>(1, 21));

TEST_P(RandomSystems, direct_solvers_find_the_same_solution_of_any_regular_matrix) {
  // No dominance at all: only pivoting saves these.
  const SparseMatrix a = random_matrix(150, 5, false, 0, GetParam());
  const std::vector<double> exact = random_vector(150, GetParam() + 100);
  std::vector<double> b(150);
  multiply(a, exact, b);
  BandedSolver banded(natural_order(*a.pattern));
  SparseDirectSolver general(false);
  EXPECT_LT(difference(solution(banded, a, b), exact), 1e-9);
  EXPECT_LT(difference(solution(general, a, b), exact), 1e-9);
}

TEST_P(RandomSystems, all_direct_solvers_agree_on_symmetric_definite_matrices) {
  const SparseMatrix a = random_matrix(150, 4, true, 1.05, GetParam());
  const std::vector<double> exact = random_vector(150, GetParam() + 100);
  std::vector<double> b(150);
  multiply(a, exact, b);
  const Ordering order = natural_order(*a.pattern);
  BandedSolver lu(order);
  BandedSolver cholesky(order, {}, {}, true);
  SparseDirectSolver general(false);
  SparseDirectSolver symmetric(true);
  for (LinearSolver* solver :
       {static_cast<LinearSolver*>(&lu), static_cast<LinearSolver*>(&cholesky),
        static_cast<LinearSolver*>(&general), static_cast<LinearSolver*>(&symmetric)}) {
    EXPECT_LT(difference(solution(*solver, a, b), exact), 1e-12) << solver->describe();
  }
}

TEST_P(RandomSystems, iterations_agree_with_the_band_whatever_the_numbering) {
  const auto system = particle_laplacian<2>({30, 8}, ChannelEnds::outlet, 0.25, GetParam());
  const std::vector<double> b = random_vector(system.matrix.rows(), GetParam());
  BandedSolver banded(column_order(*system.matrix.pattern, system.layout(), 1), tight, {}, true);
  const std::vector<double> expected = solution(banded, system.matrix, b);

  std::vector<std::size_t> place(b.size());
  std::iota(place.begin(), place.end(), 0);
  std::mt19937_64 random(GetParam());
  std::shuffle(place.begin(), place.end(), random);
  const SparseMatrix mixed = renumbered(system.matrix, place);
  std::vector<Vector<2>> positions(b.size());
  std::vector<double> mixed_b(b.size());
  for (std::size_t i = 0; i < b.size(); ++i) {
    positions[place[i]] = system.positions[i];
    mixed_b[place[i]] = b[i];
  }
  const NodeLayout<2> layout{positions, 1, {0, 0}, 0};
  BandedSolver mixed_band(column_order(*mixed.pattern, layout, 1), tight);
  AggregateSolver<2> symmetric(layout, true, tight);
  AggregateSolver<2> general(layout, false, tight);
  for (LinearSolver* solver :
       {static_cast<LinearSolver*>(&mixed_band), static_cast<LinearSolver*>(&symmetric),
        static_cast<LinearSolver*>(&general)}) {
    const std::vector<double> x = solution(*solver, mixed, mixed_b);
    std::vector<double> back(b.size());
    for (std::size_t i = 0; i < b.size(); ++i) {
      back[i] = x[place[i]];
    }
    EXPECT_LT(difference(back, expected), 1e-9) << solver->describe();
  }
}

// With a null space: P A x = P b, whatever the method; b is out of reach on purpose.
void expect_all_agree(const ModelSystem<2>& system, bool symmetric, std::uint64_t seed) {
  const std::vector<double> b = random_vector(system.matrix.rows(), seed);
  const ConstantNullSpace constants;
  SparseDirectSolver general(false, tight, constants);
  const std::vector<double> expected = solution(general, system.matrix, b);
  EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0), 0, 1e-9);
  std::vector<double> product(b.size());
  multiply(system.matrix, expected, product);
  const double missed = b[0] - product[0];
  for (std::size_t i = 0; i < b.size(); ++i) {
    EXPECT_NEAR(b[i] - product[i], missed, 1e-10);
  }
  const Ordering order = column_order(*system.matrix.pattern, system.layout(), 1);
  BandedSolver band(order, tight, constants, symmetric);
  SparseDirectSolver direct(symmetric, tight, constants);
  AggregateSolver<2> aggregate(system.layout(), symmetric, tight, constants);
  for (LinearSolver* solver :
       {static_cast<LinearSolver*>(&band), static_cast<LinearSolver*>(&direct),
        static_cast<LinearSolver*>(&aggregate)}) {
    EXPECT_LT(difference(solution(*solver, system.matrix, b), expected), 1e-8)
        << solver->describe();
  }
}

TEST_P(RandomSystems, all_agree_where_constants_are_a_null_space) {
  expect_all_agree(particle_laplacian<2>({40, 8}, ChannelEnds::closed, 0.2, GetParam()), true,
                   GetParam());
  expect_all_agree(particle_laplacian<2>({40, 8}, ChannelEnds::periodic, 0.2, GetParam()), true,
                   GetParam());
  expect_all_agree(particle_laplacian<2>({40, 8}, ChannelEnds::closed, 0.2, GetParam(), 3), false,
                   GetParam());
  expect_all_agree(least_squares_laplacian(40, 8, 3.1, 0.2, GetParam(), true), false, GetParam());
}

TEST_P(RandomSystems, all_agree_on_least_squares_operators) {
  const auto system = least_squares_laplacian(40, 10, 2.9, 0.2, GetParam());
  const std::vector<double> b = random_vector(system.matrix.rows(), GetParam());
  BandedSolver band(column_order(*system.matrix.pattern, system.layout(), 1), tight);
  AggregateSolver<2> aggregate(system.layout(), false, tight);
  EXPECT_LT(difference(solution(aggregate, system.matrix, b), solution(band, system.matrix, b)),
            1e-9);
}

class Threads : public testing::Test {
 protected:
  void TearDown() override { omp_set_num_threads(before_); }
  int before_ = omp_get_max_threads();
};

TEST_F(Threads, do_not_change_a_bit) {
  // Large enough that every loop is shared.
  const auto symmetric = particle_laplacian<2>({500, 80}, ChannelEnds::outlet, 0.2, 1);
  const auto general = particle_laplacian<2>({500, 80}, ChannelEnds::closed, 0.2, 1, 1.0);
  std::vector<std::vector<double>> solutions;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    AggregateSolver<2> cg(symmetric.layout(), true);
    solutions.push_back(solution(cg, symmetric.matrix, random_vector(symmetric.matrix.rows(), 2)));
    AggregateSolver<2> gmres(general.layout(), false, {}, ConstantNullSpace{});
    solutions.push_back(solution(gmres, general.matrix, random_vector(general.matrix.rows(), 2)));
    BandedSolver band(column_order(*symmetric.matrix.pattern, symmetric.layout(), 1));
    solutions.push_back(
        solution(band, symmetric.matrix, random_vector(symmetric.matrix.rows(), 2)));
  }
  for (std::size_t i = 3; i < solutions.size(); ++i) {
    EXPECT_EQ(solutions[i], solutions[i % 3]) << i;
  }
}

TEST(History, does_not_change_a_bit) {
  // A solver that has seen other values before gives what a new one gives: a restarted run goes on
  // with the same bits.
  const auto system = particle_laplacian<2>({60, 12}, ChannelEnds::outlet, 0.2, 1);
  SparseMatrix other = system.matrix;
  const std::vector<double> noise = random_vector(other.rows(), 3);
  for (std::size_t i = 0; i < other.rows(); ++i) {
    other.values[other.pattern->entry(i, static_cast<std::int32_t>(i))] += 2 + noise[i];
  }
  const std::vector<double> b = random_vector(other.rows(), 4);
  const auto same_as_new = [&](LinearSolver& used, LinearSolver& fresh) {
    solution(used, other, b);
    EXPECT_EQ(solution(used, system.matrix, b), solution(fresh, system.matrix, b))
        << used.describe();
  };
  AggregateSolver<2> used(system.layout(), true);
  AggregateSolver<2> fresh(system.layout(), true);
  same_as_new(used, fresh);
  SparseDirectSolver used_ldlt(true);
  SparseDirectSolver fresh_ldlt(true);
  same_as_new(used_ldlt, fresh_ldlt);
  SparseDirectSolver used_lu(false);
  SparseDirectSolver fresh_lu(false);
  same_as_new(used_lu, fresh_lu);
}

}  // namespace
}  // namespace hemoscale::micro
