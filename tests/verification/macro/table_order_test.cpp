#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "macro/viscosity/carreau_yasuda.hpp"
#include "macro/viscosity/viscosity_table.hpp"

namespace hemoscale::macro {
namespace {

ViscosityTable sampled(const CarreauYasuda& law, int intervals) {
  ViscosityRow row;
  row.hematocrit = 0.45;
  for (int i = 0; i <= intervals; ++i) {
    const double rate = 1e-2 * std::pow(1e5, static_cast<double>(i) / intervals);
    row.shear_rates.push_back(rate);
    row.viscosities.push_back(viscosity(law, rate, 0.45));
  }
  return ViscosityTable({row});
}

struct Errors {
  double value = 0;  // largest |log(viscosity) - exact| [-]
  double slope = 0;  // largest error of the logarithmic slope [-]
};

Errors errors(const CarreauYasuda& law, int intervals) {
  const ViscosityTable table = sampled(law, intervals);
  Errors largest;
  for (int i = 0; i <= 5000; ++i) {
    const double rate = 1e-2 * std::pow(1e5, i / 5000.0);
    const double exact = viscosity(law, rate, 0.45);
    largest.value =
        std::max(largest.value, std::abs(std::log(table.viscosity(rate, 0.45) / exact)));
    largest.slope = std::max(largest.slope, std::abs(table.logarithmic_slope(rate, 0.45) -
                                                     logarithmic_slope(law, rate, 0.45)));
  }
  return largest;
}

double order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

TEST(ViscosityTableOrder, is_three_for_a_smooth_law_and_two_for_its_slope) {
  const CarreauYasuda law = cho_kensey_1991();
  const Errors coarse = errors(law, 80);
  const Errors middle = errors(law, 160);
  const Errors fine = errors(law, 320);
  for (const double observed :
       {order(coarse.value, middle.value), order(middle.value, fine.value)}) {
    EXPECT_GT(observed, 2.7);
    EXPECT_LT(observed, 3.5);
  }
  for (const double observed :
       {order(coarse.slope, middle.slope), order(middle.slope, fine.slope)}) {
    EXPECT_GT(observed, 1.7);
    EXPECT_LT(observed, 2.5);
  }
}

TEST(ViscosityTableOrder, eight_knots_per_decade_give_one_per_mille_of_blood) {
  EXPECT_LT(errors(cho_kensey_1991(), 40).value, 1e-3);
}

}  // namespace
}  // namespace hemoscale::macro
