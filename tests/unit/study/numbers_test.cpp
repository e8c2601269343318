#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "coupling/error.hpp"
#include "coupling/study/bisection.hpp"
#include "coupling/study/measure.hpp"
#include "coupling/study/order_fit.hpp"
#include "coupling/study/pareto.hpp"

namespace hemoscale::coupling {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(OrderFit, finds_the_slope_of_an_exact_power) {
  for (const double order : {0.5, 1.0, 2.0, 4.0}) {
    std::vector<double> h = {8e-6, 4e-6, 1e-6, 0.5e-6};
    std::vector<double> error;
    for (const double each : h) error.push_back(3e4 * std::pow(each, order));
    const OrderFit fit = fit_order(h, error);
    EXPECT_NEAR(fit.order, order, 1e-12);
    EXPECT_NEAR(fit.standard_error, 0, 1e-12);
    EXPECT_EQ(fit.points, 4);
    ASSERT_EQ(fit.pairwise.size(), 3U);
    for (const double pair : fit.pairwise) EXPECT_NEAR(pair, order, 1e-12);
  }
}

TEST(OrderFit, an_axis_that_grows_with_refinement_has_a_positive_order) {
  const OrderFit fit = fit_order(std::vector<double>{10, 20, 40}, std::vector<double>{16, 4, 1});
  EXPECT_NEAR(fit.order, 2, 1e-12);
  EXPECT_THAT(fit.pairwise,
              ElementsAre(testing::DoubleNear(2, 1e-12), testing::DoubleNear(2, 1e-12)));
}

TEST(OrderFit, standard_error_is_that_of_a_straight_line_fit) {
  // x = ln h = 0, 1, 2 and y = 0, 1, 3: slope 3/2, residuals 1/6, -1/3, 1/6, S = 2.
  const double e = std::exp(1.0);
  const OrderFit fit =
      fit_order(std::vector<double>{e * e, e, 1}, std::vector<double>{std::exp(3.0), e, 1});
  EXPECT_NEAR(fit.order, 1.5, 1e-12);
  EXPECT_NEAR(fit.standard_error, std::sqrt(1.0 / 6 / 2), 1e-12);
  EXPECT_THAT(fit.pairwise,
              ElementsAre(testing::DoubleNear(2, 1e-12), testing::DoubleNear(1, 1e-12)));
}

TEST(OrderFit, runs_without_an_error_do_not_count) {
  const OrderFit fit =
      fit_order(std::vector<double>{8, 4, 2, 1}, std::vector<double>{8, nan, 2, 0});
  EXPECT_EQ(fit.points, 2);
  EXPECT_NEAR(fit.order, 1, 1e-12);
  EXPECT_TRUE(std::isnan(fit.standard_error));
  EXPECT_TRUE(std::isnan(fit_order(std::vector<double>{1}, std::vector<double>{1}).order));
  EXPECT_TRUE(std::isnan(fit_order(std::vector<double>{1, 1}, std::vector<double>{1, 2}).order));
}

TEST(ParetoFront, holds_the_runs_that_nothing_beats) {
  EXPECT_THAT(
      pareto_front(std::vector<double>{1, 2, 3, 4, 1.5}, std::vector<double>{9, 3, 3, 1, 9}),
      ElementsAre(true, true, false, true, false));
}

TEST(ParetoFront, equals_share_it_and_runs_without_error_neither_count_nor_beat) {
  EXPECT_THAT(pareto_front(std::vector<double>{1, 1, 0.1, 0.1},
                           std::vector<double>{2, 2, nan, std::numeric_limits<double>::infinity()}),
              ElementsAre(true, true, false, false));
  EXPECT_TRUE(pareto_front({}, {}).empty());
}

TEST(Bisection, brackets_a_boundary_within_the_tolerance) {
  for (const double boundary : {1.1e-8, 3e-7, 9e-6}) {
    int asked = 0;
    const BoundarySearch search = find_boundary(1e-8, 1e-5, 0.02, [&](double value) {
      ++asked;
      return value < boundary;
    });
    EXPECT_EQ(search.outcome, BoundarySearch::Outcome::found);
    EXPECT_LT(search.stable, boundary);
    EXPECT_GE(search.unstable, boundary);
    EXPECT_LE(search.unstable, 1.02 * search.stable);
    EXPECT_EQ(search.asked, asked);
    EXPECT_EQ(asked, 11);  // 2 ends, and 2^9 > ln(1000) / ln(1.02)
  }
}

TEST(Bisection, stability_may_lie_at_the_larger_values) {
  const BoundarySearch search = find_boundary(100, 1, 0.01, [](double value) { return value > 7; });
  EXPECT_GT(search.stable, 7);
  EXPECT_LE(search.unstable, 7);
  EXPECT_LE(search.stable, 1.01 * search.unstable);
}

TEST(Bisection, says_if_the_ends_do_not_differ) {
  EXPECT_EQ(find_boundary(1, 2, 0.1, [](double) { return true; }).outcome,
            BoundarySearch::Outcome::stable_everywhere);
  EXPECT_EQ(find_boundary(1, 2, 0.1, [](double) { return false; }).outcome,
            BoundarySearch::Outcome::stable_nowhere);
}

TEST(Measure, figure_that_is_the_error) {
  ErrorMeasure measure;
  EXPECT_THAT(errors_of(measure, {{"a", "", false, -3}, {"a", "", true, 2}}), ElementsAre(3, 2));
}

TEST(Measure, relative_to_a_number) {
  ErrorMeasure measure;
  measure.against = ErrorMeasure::Against::number;
  measure.reference = -4;
  EXPECT_THAT(errors_of(measure, {{"a", "", false, -3}, {"a", "", true, 4}}), ElementsAre(0.25, 2));
}

TEST(Measure, relative_to_the_finest_of_the_same_series_and_family) {
  ErrorMeasure measure;
  measure.against = ErrorMeasure::Against::finest;
  const std::vector<Measured> runs = {{"a", "x", false, 3}, {"a", "x", true, 2},
                                      {"a", "y", false, 3}, {"a", "y", true, 4},
                                      {"b", "x", false, 1}, {"b", "x", true, nan}};
  EXPECT_THAT(errors_of(measure, runs), ElementsAre(0.5, testing::IsNan(), 0.25, testing::IsNan(),
                                                    testing::IsNan(), testing::IsNan()));
  measure.series = "a";
  EXPECT_THAT(errors_of(measure, runs),
              ElementsAre(0.5, testing::IsNan(), 0.25, testing::IsNan(), 0.5, testing::IsNan()));
}

TEST(Measure, a_reference_of_zero_is_refused) {
  ErrorMeasure measure;
  measure.against = ErrorMeasure::Against::finest;
  EXPECT_THROW(errors_of(measure, {{"a", "", false, 3}, {"a", "", true, 0}}), CaseError);
}

TEST(Measure, a_figure_that_is_not_there_is_answered_with_those_that_are) {
  Summary summary;
  summary.figures = {{"mean velocity", 1, "m/s"}, {"flow rate", 2, "m^2/s"}};
  EXPECT_EQ(figure_of(summary, "flow rate", {}, "error.figure", "r").value, 2);
  try {
    figure_of(summary, "mean velocty", {"study.toml", 3, 4}, "error.figure", "r");
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_THAT(error.what(), HasSubstr("study.toml:3:4: error.figure"));
    EXPECT_THAT(error.what(), HasSubstr("the nearest is \"mean velocity\""));
    EXPECT_THAT(error.what(), HasSubstr("flow rate"));
  }
}

}  // namespace
}  // namespace hemoscale::coupling
