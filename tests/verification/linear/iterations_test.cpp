// The iterations with multigrid do not grow with the system: what makes their time proportional to
// its size. The largest sizes are in the benchmark (micro/linear/README.md).

#include <gtest/gtest.h>

#include <cmath>

#include "micro/linear/aggregate_solver.hpp"
#include "tests/support/linear/model_systems.hpp"

namespace hemoscale::micro {
namespace {

template <int dim>
int iterations(const ModelSystem<dim>& system, bool symmetric,
               std::optional<ConstantNullSpace> null_space = {}) {
  const std::vector<double> b = random_vector(system.matrix.rows(), 1);
  std::vector<double> x(b.size());
  AggregateSolver<dim> solver(system.layout(), symmetric, {1e-8, 100}, null_space);
  solver.prepare(system.matrix);
  const SolveReport report = solver.solve(b, x);
  if (!null_space) {
    EXPECT_LE(relative_residual(system.matrix, x, b), 1.01e-8);
  }
  return report.iterations;
}

// Within 20 %, or one iteration of so few.
void expect_flat(int small, int large, int most) {
  EXPECT_LE(std::abs(large - small), std::max(1.0, 0.2 * small)) << small << " to " << large;
  EXPECT_LE(small, most);
  EXPECT_LE(large, most);
}

ModelSystem<2> channel(int across, ChannelEnds ends, double uneven = 0) {
  return particle_laplacian<2>({8 * across + 1, across}, ends, 0.2, 1, uneven);
}

TEST(Iterations, are_flat_for_the_particle_laplacian_of_a_channel) {
  expect_flat(iterations(channel(25, ChannelEnds::outlet), true),
              iterations(channel(50, ChannelEnds::outlet), true), 8);
}

TEST(Iterations, are_flat_with_constants_as_null_space) {
  const ConstantNullSpace constants;
  expect_flat(iterations(channel(25, ChannelEnds::closed), true, constants),
              iterations(channel(50, ChannelEnds::closed), true, constants), 8);
  expect_flat(iterations(channel(25, ChannelEnds::periodic), true, constants),
              iterations(channel(50, ChannelEnds::periodic), true, constants), 8);
  expect_flat(iterations(channel(25, ChannelEnds::closed, 3), false, constants),
              iterations(channel(50, ChannelEnds::closed, 3), false, constants), 10);
}

TEST(Iterations, are_flat_for_least_squares_operators) {
  for (const double range : {2.5, 3.1}) {
    expect_flat(iterations(least_squares_laplacian(200, 25, range, 0.2, 1), false),
                iterations(least_squares_laplacian(400, 50, range, 0.2, 1), false), 12);
  }
}

TEST(Iterations, are_flat_in_three_dimensions) {
  const auto duct = [](int across) {
    return particle_laplacian<3>({2 * across + 1, across, across}, ChannelEnds::outlet, 0.2, 1);
  };
  expect_flat(iterations(duct(10), true), iterations(duct(20), true), 8);
}

}  // namespace
}  // namespace hemoscale::micro
