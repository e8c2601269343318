#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>

#include "micro/error.hpp"
#include "micro/linear/hypre_solver.hpp"
#include "micro/linear/sparse_direct_solver.hpp"
#include "tests/support/linear/model_systems.hpp"

namespace hemoscale::micro {
namespace {

using testing::HasSubstr;

// The rows of a rank, where the first `holders` ranks share them all.
SparseMatrix part(const SparseMatrix& whole, int rank, int holders) {
  const std::size_t rows = whole.rows();
  const auto bound = [&](int r) {
    return rows * static_cast<std::size_t>(std::min(r, holders)) /
           static_cast<std::size_t>(holders);
  };
  const std::size_t begin = bound(rank);
  const std::size_t end = bound(rank + 1);
  const auto offset = whole.pattern->first[begin];
  auto pattern = std::make_shared<SparsePattern>();
  pattern->row_begin = begin;
  pattern->global_rows = rows;
  pattern->first.clear();
  for (std::size_t i = begin; i <= end; ++i) {
    pattern->first.push_back(whole.pattern->first[i] - offset);
  }
  pattern->columns.assign(whole.pattern->columns.begin() + offset,
                          whole.pattern->columns.begin() + whole.pattern->first[end]);
  SparseMatrix own(pattern);
  own.values.assign(whole.values.begin() + offset,
                    whole.values.begin() + whole.pattern->first[end]);
  return own;
}

void expect_same_as_serial(const ModelSystem<2>& system, bool symmetric,
                           std::optional<ConstantNullSpace> null_space, int idle_ranks = 0) {
  const Communicator ranks(MPI_COMM_WORLD);
  const std::vector<double> b = random_vector(system.matrix.rows(), 1);
  std::vector<double> expected(b.size());
  SparseDirectSolver serial(symmetric, {1e-11, 1}, null_space);
  serial.prepare(system.matrix);
  serial.solve(b, expected);

  HypreSolver solver(ranks, symmetric, {1e-11, 200}, null_space);
  const int holders = std::max(1, ranks.size() - idle_ranks);
  solver.prepare(part(system.matrix, ranks.rank(), holders));
  std::vector<double> x(b.size());
  const SolveReport report = solver.solve(b, x);
  EXPECT_LE(report.relative_residual, 1e-11);
  EXPECT_LE(report.iterations, 30);
  double largest = 0;
  double apart = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    largest = std::max(largest, std::abs(expected[i]));
    apart = std::max(apart, std::abs(x[i] - expected[i]));
  }
  EXPECT_LT(apart, 1e-8 * largest) << solver.describe();

  // Whole and the same, to the bit, on all ranks.
  const std::string bytes(reinterpret_cast<const char*>(x.data()), x.size() * sizeof(double));
  for (const std::string& each : ranks.all_gather(bytes)) {
    EXPECT_TRUE(each == bytes);
  }
}

TEST(HypreSolver, agrees_with_a_serial_solver_on_symmetric_systems) {
  expect_same_as_serial(particle_laplacian<2>({120, 15}, ChannelEnds::outlet, 0.2, 1), true, {});
}

TEST(HypreSolver, agrees_with_a_serial_solver_on_negative_definite_systems) {
  auto system = particle_laplacian<2>({120, 15}, ChannelEnds::outlet, 0.2, 1);
  for (double& value : system.matrix.values) value = -value;
  expect_same_as_serial(system, true, {});
}

TEST(HypreSolver, agrees_with_a_serial_solver_on_systems_that_are_not_symmetric) {
  expect_same_as_serial(least_squares_laplacian(100, 15, 3.1, 0.2, 1), false, {});
}

TEST(HypreSolver, agrees_with_a_serial_solver_where_constants_are_a_null_space) {
  expect_same_as_serial(particle_laplacian<2>({120, 15}, ChannelEnds::closed, 0.2, 1), true,
                        ConstantNullSpace{});
  expect_same_as_serial(particle_laplacian<2>({120, 15}, ChannelEnds::periodic, 0.2, 1, 2), false,
                        ConstantNullSpace{});
}

TEST(HypreSolver, a_rank_may_hold_no_row) {
  expect_same_as_serial(particle_laplacian<2>({60, 8}, ChannelEnds::outlet, 0.2, 1), true, {}, 1);
}

TEST(HypreSolver, a_fault_on_the_last_rank_is_the_same_fault_on_all) {
  const Communicator ranks(MPI_COMM_WORLD);
  auto system = particle_laplacian<2>({60, 8}, ChannelEnds::outlet, 0.2, 1);
  system.matrix.values.back() = std::nan("");
  HypreSolver solver(ranks, true);
  EXPECT_THAT([&] { solver.prepare(part(system.matrix, ranks.rank(), ranks.size())); },
              testing::ThrowsMessage<NumericalError>(
                  HasSubstr("rank " + std::to_string(ranks.size() - 1) + ": matrix entry")));
  std::vector<double> x(system.matrix.rows());
  EXPECT_THROW(solver.solve(x, x), ParameterError);  // nothing is prepared
}

TEST(HypreSolver, all_ranks_report_that_it_does_not_converge) {
  const Communicator ranks(MPI_COMM_WORLD);
  const auto system = particle_laplacian<2>({120, 15}, ChannelEnds::outlet, 0.2, 1);
  HypreSolver solver(ranks, true, {1e-10, 2});
  solver.prepare(part(system.matrix, ranks.rank(), ranks.size()));
  std::vector<double> x(system.matrix.rows());
  EXPECT_THAT([&] { solver.solve(random_vector(x.size(), 1), x); },
              testing::ThrowsMessage<NumericalError>(HasSubstr("2 of at most 2 iterations")));
}

TEST(HypreSolver, refuses_rows_that_do_not_add_up) {
  const Communicator ranks(MPI_COMM_WORLD);
  std::vector<double> own(3);
  std::vector<double> whole(own.size() * static_cast<std::size_t>(ranks.size()) + 1);
  EXPECT_THROW(ranks.all_gather_ranges(own.data(), own.size(), whole.data(), whole.size()),
               EnvironmentError);
}

TEST(Communicator, joins_ranges_in_the_order_of_the_ranks) {
  const Communicator ranks(MPI_COMM_WORLD);
  const std::vector<double> own(static_cast<std::size_t>(ranks.rank()), ranks.rank());
  std::vector<double> expected;
  for (int rank = 0; rank < ranks.size(); ++rank) {
    expected.insert(expected.end(), static_cast<std::size_t>(rank), rank);
  }
  std::vector<double> whole(expected.size());
  ranks.all_gather_ranges(own.data(), own.size(), whole.data(), whole.size());
  EXPECT_EQ(whole, expected);
}

}  // namespace
}  // namespace hemoscale::micro

int main(int count, char** arguments) {
  MPI_Init(&count, &arguments);
  testing::InitGoogleTest(&count, arguments);
  const int result = RUN_ALL_TESTS();
  MPI_Finalize();
  return result;
}
