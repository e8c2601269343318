#include "macro/viscosity/viscosity_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "macro/error.hpp"
#include "macro/viscosity/monotone_slopes.hpp"

namespace hemoscale::macro {
namespace {

using testing::HasSubstr;

ViscosityTable one_row(std::vector<double> rates, std::vector<double> viscosities) {
  return ViscosityTable({{0.4, std::move(rates), std::move(viscosities)}});
}

std::string refusal(std::vector<ViscosityRow> rows) {
  try {
    const ViscosityTable table(std::move(rows));
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(ViscosityTable, passes_through_its_knots) {
  const std::vector<double> rates{0.1, 0.7, 2, 50, 900};
  const std::vector<double> viscosities{60e-3, 20e-3, 21e-3, 5e-3, 3.5e-3};
  const ViscosityTable table = one_row(rates, viscosities);
  for (std::size_t i = 0; i < rates.size(); ++i) {
    EXPECT_NEAR(table.viscosity(rates[i], 0.4), viscosities[i], 1e-14 * viscosities[i]);
  }
}

TEST(ViscosityTable, reproduces_a_power_law_on_uneven_knots) {
  const auto law = [](double rate) { return 0.017 * std::pow(rate, -0.37); };
  const std::vector<double> rates{0.1, 0.13, 2, 3, 400};
  std::vector<double> viscosities;
  std::transform(rates.begin(), rates.end(), std::back_inserter(viscosities), law);
  const ViscosityTable table = one_row(rates, viscosities);
  for (int i = 0; i <= 50; ++i) {
    const double rate = std::min(0.1 * std::pow(4000, i / 50.0), 400.0);
    EXPECT_NEAR(table.viscosity(rate, 0.4), law(rate), 1e-13 * law(rate)) << rate;
    EXPECT_NEAR(table.logarithmic_slope(rate, 0.4), -0.37, 1e-12) << rate;
  }
}

TEST(ViscosityTable, holds_the_outer_values) {
  const ViscosityTable table = one_row({1, 10}, {5e-3, 4e-3});
  EXPECT_NEAR(table.viscosity(0.999, 0.4), 5e-3, 1e-17);
  EXPECT_NEAR(table.viscosity(0, 0.4), 5e-3, 1e-17);
  EXPECT_NEAR(table.viscosity(1e9, 0.4), 4e-3, 1e-17);
  EXPECT_LT(table.viscosity(1.001, 0.4), 5e-3 * (1 - 1e-5));
  EXPECT_EQ(table.logarithmic_slope(0.999, 0.4), 0);
  EXPECT_NEAR(table.logarithmic_slope(1, 0.4), std::log10(0.8), 1e-14);
  EXPECT_NEAR(table.logarithmic_slope(10, 0.4), std::log10(0.8), 1e-14);
  EXPECT_EQ(table.logarithmic_slope(10.01, 0.4), 0);
}

TEST(ViscosityTable, a_row_with_one_knot_is_constant) {
  const ViscosityTable table = one_row({7}, {4e-3});
  for (const double rate : {0.0, 1e-3, 7.0, 1e5}) {
    EXPECT_NEAR(table.viscosity(rate, 0.4), 4e-3, 1e-17);
    EXPECT_EQ(table.logarithmic_slope(rate, 0.4), 0);
  }
}

TEST(ViscosityTable, is_the_weighted_geometric_mean_between_rows) {
  const ViscosityTable table({{0.2, {1}, {2e-3}}, {0.4, {1}, {8e-3}}, {0.5, {1}, {9e-3}}});
  EXPECT_NEAR(table.viscosity(1, 0.3), 4e-3, 1e-17);
  EXPECT_NEAR(table.viscosity(1, 0.25), 2e-3 * std::pow(4, 0.25), 1e-17);
  EXPECT_NEAR(table.viscosity(1, 0.45), std::sqrt(72e-6), 1e-17);
  EXPECT_NEAR(table.viscosity(1, 0.2), 2e-3, 1e-17);
  EXPECT_NEAR(table.viscosity(1, 0.4), 8e-3, 1e-17);
  EXPECT_NEAR(table.viscosity(1, 0.1), 2e-3, 1e-17);
  EXPECT_NEAR(table.viscosity(1, 0.9), 9e-3, 1e-17);
}

TEST(ViscosityTable, knows_where_nothing_is_held) {
  const ViscosityTable table({{0.2, {1, 10}, {2, 1}}, {0.4, {5, 50}, {2, 1}}});
  EXPECT_TRUE(table.in_range(1, 0.2));
  EXPECT_TRUE(table.in_range(10, 0.2));
  EXPECT_FALSE(table.in_range(0.99, 0.2));
  EXPECT_FALSE(table.in_range(10.1, 0.2));
  EXPECT_TRUE(table.in_range(5, 0.3));
  EXPECT_FALSE(table.in_range(4.9, 0.3));  // held in the upper row
  EXPECT_FALSE(table.in_range(10.1, 0.3));
  EXPECT_TRUE(table.in_range(50, 0.4));
  // On a row in the middle the rows beside it take no part.
  const ViscosityTable three({{0.2, {1}, {1}}, {0.3, {5, 50}, {2, 1}}, {0.4, {1}, {1}}});
  EXPECT_TRUE(three.in_range(20, 0.3));
  EXPECT_FALSE(three.in_range(20, 0.299));
  EXPECT_FALSE(table.in_range(7, 0.19));
  EXPECT_FALSE(table.in_range(7, 0.41));
  EXPECT_FALSE(table.in_range(std::numeric_limits<double>::quiet_NaN(), 0.3));
  EXPECT_FALSE(table.in_range(7, std::numeric_limits<double>::quiet_NaN()));
}

TEST(ViscosityTable, passes_values_that_are_not_numbers_on) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ViscosityTable table({{0.2, {1, 10}, {2, 1}}, {0.4, {5, 50}, {2, 1}}});
  EXPECT_TRUE(std::isnan(table.viscosity(nan, 0.3)));
  EXPECT_TRUE(std::isnan(table.viscosity(7, nan)));
}

TEST(ViscosityTable, a_copy_is_independent) {
  ViscosityTable table = one_row({1, 10}, {5e-3, 4e-3});
  const ViscosityTable copy = table;
  table = one_row({1, 10}, {7e-3, 4e-3});
  EXPECT_NEAR(copy.viscosity(1, 0.4), 5e-3, 1e-17);
  EXPECT_EQ(copy.rows().front().viscosities.front(), 5e-3);
}

TEST(ViscosityTable, names_the_first_bad_entry) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal({}), HasSubstr("no rows"));
  EXPECT_THAT(refusal({{0.4, {}, {}}}), HasSubstr("row 0: shear_rates is empty"));
  EXPECT_THAT(refusal({{0.4, {1, 2}, {1}}}), HasSubstr("1 viscosities for 2 shear rates"));
  EXPECT_THAT(refusal({{0.4, {0, 2}, {1, 1}}}), HasSubstr("shear_rates[0] = 0 1/s"));
  EXPECT_THAT(refusal({{0.4, {1, nan}, {1, 1}}}), HasSubstr("shear_rates[1] = nan"));
  EXPECT_THAT(refusal({{0.4, {1, inf}, {1, 1}}}), HasSubstr("shear_rates[1] = inf"));
  EXPECT_THAT(refusal({{0.4, {1, 2, 2}, {1, 1, 1}}}), HasSubstr("shear_rates[2] = 2 1/s"));
  EXPECT_THAT(refusal({{0.4, {1, 2, 1.9}, {1, 1, 1}}}), HasSubstr("shear_rates[2] = 1.9 1/s"));
  EXPECT_THAT(refusal({{0.4, {1, 2}, {1, -3}}}), HasSubstr("viscosities[1] = -3 Pa s"));
  EXPECT_THAT(refusal({{0.4, {1, 2}, {0, 1}}}), HasSubstr("viscosities[0] = 0 Pa s"));
  EXPECT_THAT(refusal({{0.4, {1}, {nan}}}), HasSubstr("viscosities[0] = nan"));
  EXPECT_THAT(refusal({{45, {1}, {1}}}), HasSubstr("hematocrit = 45"));
  EXPECT_THAT(refusal({{nan, {1}, {1}}}), HasSubstr("hematocrit = nan"));
  EXPECT_THAT(refusal({{0.4, {1}, {1}}, {0.4, {1}, {1}}}), HasSubstr("row 1: hematocrit = 0.4"));
  EXPECT_THAT(refusal({{0.4, {1}, {1}}, {0.3, {1}, {1}}}), HasSubstr("row 1: hematocrit = 0.3"));
}

TEST(ViscosityTable, refuses_knots_that_rounding_makes_one) {
  const double next = std::nextafter(1e-3, 1.0);
  ASSERT_EQ(std::log(next), std::log(1e-3));
  EXPECT_THAT(refusal({{0.4, {1e-3, next}, {2, 1}}}), HasSubstr("shear_rates[1]"));
}

TEST(MonotoneSlopes, of_a_parabola_are_exact_where_it_is_monotone) {
  const std::vector<double> x{1, 1.5, 1.7, 2.5, 4};
  std::vector<double> y;
  std::transform(x.begin(), x.end(), std::back_inserter(y), [](double at) { return at * at; });
  const std::vector<double> slopes = monotone_slopes(x, y);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(slopes[i], 2 * x[i], 1e-13);
}

TEST(MonotoneSlopes, vanish_at_extremes_and_beside_flat_pieces) {
  const std::vector<double> slopes = monotone_slopes({0, 1, 2, 3, 4, 5}, {0, 1, 0.5, 0.5, 2, 1});
  EXPECT_EQ(slopes[1], 0);
  EXPECT_EQ(slopes[2], 0);
  EXPECT_EQ(slopes[3], 0);
  EXPECT_EQ(slopes[4], 0);
}

TEST(MonotoneSlopes, lie_on_the_circle_of_radius_three_beside_a_step) {
  const std::vector<double> slopes = monotone_slopes({0, 1, 2, 3}, {0, 1, 1.01, 2});
  EXPECT_NEAR(std::hypot(slopes[1], slopes[2]), 3 * 0.01, 1e-15);
}

TEST(MonotoneSlopes, of_one_and_two_knots) {
  EXPECT_EQ(monotone_slopes({3}, {1}), std::vector<double>({0}));
  EXPECT_EQ(monotone_slopes({0, 2}, {1, 5}), std::vector<double>({2, 2}));
}

}  // namespace
}  // namespace hemoscale::macro
