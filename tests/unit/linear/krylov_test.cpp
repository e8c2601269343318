#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "micro/error.hpp"
#include "micro/linear/conjugate_gradient.hpp"
#include "micro/linear/flexible_gmres.hpp"
#include "tests/support/linear/model_systems.hpp"

namespace hemoscale::micro {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

void identity(std::span<const double> r, std::span<double> z) {
  std::copy(r.begin(), r.end(), z.begin());
}

enum class Method { conjugate_gradient, gmres, short_gmres };

class Krylov : public testing::TestWithParam<Method> {
 protected:
  using Map = std::function<void(std::span<const double>, std::span<double>)>;

  SolveReport solve(const SparseMatrix& a, const std::vector<double>& b, std::vector<double>& x,
                    const KrylovLimits& limits = {1, 1e-12, 100},
                    const Map& precondition = identity) {
    const auto apply = [&](std::span<const double> v, std::span<double> y) { multiply(a, v, y); };
    switch (GetParam()) {
      case Method::conjugate_gradient:
        return conjugate_gradient(apply, precondition, b, x, limits);
      case Method::gmres:
        return flexible_gmres(apply, precondition, b, x, limits);
      case Method::short_gmres:
        break;
    }
    return flexible_gmres(apply, precondition, b, x, limits, 2);
  }
};

INSTANTIATE_TEST_SUITE_P(All, Krylov,
                         testing::Values(Method::conjugate_gradient, Method::gmres,
                                         Method::short_gmres));

TEST_P(Krylov, solves_a_system_known_by_hand) {
  std::vector<double> x(3);
  const SolveReport report =
      solve(sparse({{4, -1, 0}, {-1, 4, -2}, {0, -2, 5}}), {2, 1, 11}, x, {1, 1e-13, 100});
  EXPECT_THAT(x, testing::Pointwise(testing::DoubleNear(1e-12), {1.0, 2.0, 3.0}));
  EXPECT_LE(report.relative_residual, 1e-13);
  EXPECT_GE(report.iterations, 3);
}

TEST_P(Krylov, needs_no_iteration_from_the_solution) {
  std::vector<double> x = {1, 2, 3};
  EXPECT_EQ(solve(sparse({{4, -1, 0}, {-1, 4, -2}, {0, -2, 5}}), {2, 1, 11}, x).iterations, 0);
}

TEST_P(Krylov, needs_one_iteration_with_the_inverse_as_preconditioner) {
  std::vector<double> x(2);
  const SparseMatrix a = sparse({{4, 0}, {0, 8}});
  const auto inverse = [](std::span<const double> r, std::span<double> z) {
    z[0] = r[0] / 4;
    z[1] = r[1] / 8;
  };
  EXPECT_EQ(solve(a, {4, 16}, x, {1, 1e-12, 100}, inverse).iterations, 1);
  EXPECT_THAT(x, testing::ElementsAre(1, 2));
}

TEST_P(Krylov, measures_the_residual_in_parts_of_the_reference) {
  const SparseMatrix a = sparse({{4, -1, 0}, {-1, 4, -2}, {0, -2, 5}});
  std::vector<double> x(3);
  const SolveReport report = solve(a, {2, 1, 11}, x, {1e6, 1e-4, 100});
  EXPECT_EQ(report.iterations, 0);  // |b| is below 100 already
  EXPECT_NEAR(report.relative_residual, std::sqrt(126.0) * 1e-6, 1e-12);
}

TEST_P(Krylov, reports_too_many_iterations) {
  const auto system = particle_laplacian<2>({40, 10}, ChannelEnds::outlet, 0.2, 1);
  const std::vector<double> b = random_vector(system.matrix.rows(), 1);
  std::vector<double> x(b.size());
  EXPECT_THAT(
      [&] {
        solve(system.matrix, b, x, {1, 1e-12, 5});
      },
      ThrowsMessage<NumericalError>(
          testing::AllOf(HasSubstr("too many iterations"), HasSubstr("5 of at most 5"))));
}

TEST_P(Krylov, reports_values_that_are_not_finite) {
  std::vector<double> x(2);
  const SparseMatrix a = sparse({{std::numeric_limits<double>::infinity(), 0}, {0, 1}});
  EXPECT_THROW(solve(a, {1, 1}, x), NumericalError);
}

TEST_P(Krylov, reports_that_round_off_ends_all_progress) {
  const auto system = particle_laplacian<2>({30, 10}, ChannelEnds::outlet, 0.2, 1);
  const std::vector<double> b = random_vector(system.matrix.rows(), 1);
  std::vector<double> x(b.size());
  const KrylovLimits unreachable{1, 1e-30, 100000};
  EXPECT_THROW(solve(system.matrix, b, x, unreachable), NumericalError);
}

TEST_P(Krylov, reports_a_right_hand_side_out_of_reach) {
  std::vector<double> x(2);
  EXPECT_THROW(solve(sparse({{1, -1}, {-1, 1}}), {1, 1}, x), NumericalError);
}

TEST(ConjugateGradient, reports_an_indefinite_matrix) {
  const SparseMatrix a = sparse({{1, 0}, {0, -1}});
  const auto apply = [&](std::span<const double> v, std::span<double> y) { multiply(a, v, y); };
  std::vector<double> x(2);
  EXPECT_THAT(
      [&] {
        conjugate_gradient(apply, identity, std::vector<double>({1, 2}), x, KrylovLimits{});
      },
      ThrowsMessage<NumericalError>(HasSubstr("matrix is not positive definite")));
}

TEST(ConjugateGradient, reports_an_indefinite_preconditioner) {
  const SparseMatrix a = sparse({{1, 0}, {0, 2}});
  const auto apply = [&](std::span<const double> v, std::span<double> y) { multiply(a, v, y); };
  const auto negative = [](std::span<const double> r, std::span<double> z) {
    for (std::size_t i = 0; i < r.size(); ++i) z[i] = -r[i];
  };
  std::vector<double> x(2);
  EXPECT_THAT(
      [&] {
        conjugate_gradient(apply, negative, std::vector<double>({1, 2}), x, KrylovLimits{});
      },
      ThrowsMessage<NumericalError>(HasSubstr("preconditioner is not positive definite")));
}

TEST(FlexibleGmres, solves_what_no_diagonal_helps) {
  // A cyclic shift: GMRES gains nothing before the last step, and cannot be restarted earlier.
  const SparseMatrix a = sparse({{0, 1, 0}, {0, 0, 1}, {1, 0, 0}});
  const auto apply = [&](std::span<const double> v, std::span<double> y) { multiply(a, v, y); };
  const std::vector<double> b = {0, 0, 1};
  std::vector<double> x(3);
  EXPECT_EQ(flexible_gmres(apply, identity, b, x, KrylovLimits{}).iterations, 3);
  EXPECT_THAT(x, testing::Pointwise(testing::DoubleNear(1e-14), {1.0, 0.0, 0.0}));
  std::fill(x.begin(), x.end(), 0.0);
  EXPECT_THAT([&] { flexible_gmres(apply, identity, b, x, KrylovLimits{}, 2); },
              ThrowsMessage<NumericalError>(HasSubstr("stagnation")));
}

}  // namespace
}  // namespace hemoscale::micro
