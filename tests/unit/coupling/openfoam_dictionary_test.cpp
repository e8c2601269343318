#include "coupling/rheology/openfoam_dictionary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/support/coupling_doubles.hpp"

namespace hemoscale::coupling {
namespace {

using ::testing::HasSubstr;

std::vector<std::pair<double, double>> rows_of(const std::string& text) {
  std::vector<std::pair<double, double>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    double rate = 0;
    double nu = 0;
    if (std::sscanf(line.c_str(), " (%lf %lf)", &rate, &nu) == 2) rows.emplace_back(rate, nu);
  }
  return rows;
}

TEST(OpenfoamDictionary, names_the_stock_model_and_its_origin) {
  const std::string text =
      openfoam_dictionary(testing::blood(), 0.4, 1050, {1, 100, 10}, "from 2-D micro runs");
  EXPECT_THAT(text, HasSubstr("transportModel  strainRateFunction;"));
  EXPECT_THAT(text, HasSubstr("strainRateFunctionCoeffs"));
  EXPECT_THAT(text, HasSubstr("function table"));
  EXPECT_THAT(text, HasSubstr("// from 2-D micro runs\n"));
}

TEST(OpenfoamDictionary, linear_interpolation_of_the_table_gives_the_kinematic_law) {
  const double density = 1050;
  const auto rows =
      rows_of(openfoam_dictionary(testing::blood(), 0.4, density, {0.5, 2000, 50}, "test"));
  ASSERT_GT(rows.size(), 150u);
  EXPECT_EQ(rows.front().first, 0);
  EXPECT_EQ(rows.front().second, rows[1].second);
  EXPECT_EQ(rows[1].first, 0.5);
  EXPECT_EQ(rows.back().first, 2000);
  for (std::size_t i = 2; i < rows.size(); ++i) {
    ASSERT_GT(rows[i].first, rows[i - 1].first);
    const double middle = 0.5 * (rows[i].first + rows[i - 1].first);
    const double linear = 0.5 * (rows[i].second + rows[i - 1].second);
    EXPECT_NEAR(linear * density / testing::blood().viscosity(middle, 0.4), 1, 5e-4);
  }
}

TEST(OpenfoamDictionary, bad_ranges_are_refused) {
  const auto write = [](double density, const DictionaryRange& range, const char* note) {
    return openfoam_dictionary(testing::blood(), 0.4, density, range, note);
  };
  EXPECT_THROW(write(0, {1, 2, 10}, ""), std::invalid_argument);
  EXPECT_THROW(write(1050, {0, 2, 10}, ""), std::invalid_argument);
  EXPECT_THROW(write(1050, {2, 2, 10}, ""), std::invalid_argument);
  EXPECT_THROW(write(1050, {1, 2, 0}, ""), std::invalid_argument);
  EXPECT_THROW(write(1050, {1, 2, 10}, "two\nlines"), std::invalid_argument);
}

}  // namespace
}  // namespace hemoscale::coupling
