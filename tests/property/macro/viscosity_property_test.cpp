#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "macro/viscosity/viscosity_law.hpp"
#include "tests/property/macro/random_numbers.hpp"

namespace hemoscale::macro {
namespace {

// Steps of very different size, some of them zero: the hard case for a monotone interpolant.
ViscosityRow random_row(RandomNumbers& numbers, bool monotone) {
  ViscosityRow row;
  row.hematocrit = 0.4;
  double rate = numbers.log_between(1e-3, 1);
  double log_viscosity = numbers.between(-5, -2);
  const int knots = 1 + static_cast<int>(numbers.between(0, 12));
  for (int i = 0; i < knots; ++i) {
    row.shear_rates.push_back(rate);
    row.viscosities.push_back(std::exp(log_viscosity));
    rate *= 1 + numbers.log_between(1e-3, 10);
    const double size = numbers.between(0, 1) < 0.2 ? 0 : numbers.log_between(1e-6, 1);
    const bool up = !monotone && numbers.between(0, 1) < 0.5;
    log_viscosity += up ? size : -size;
  }
  return row;
}

TEST(ViscosityTableProperty, monotone_knots_stay_monotone_between) {
  RandomNumbers numbers(21);
  for (int trial = 0; trial < 400; ++trial) {
    const ViscosityTable table({random_row(numbers, true)});
    const ViscosityRow& row = table.rows().front();
    double before = table.viscosity(0, 0.4);
    const double ratio = 1.2 * row.shear_rates.back() / (0.9 * row.shear_rates.front());
    const int steps = 1 + static_cast<int>(std::log(ratio) / 0.003);
    for (int i = 0; i <= steps; ++i) {
      const double rate = 0.9 * row.shear_rates.front() * std::exp(0.003 * i);
      const double now = table.viscosity(rate, 0.4);
      ASSERT_LE(now, before * (1 + 1e-14)) << "trial " << trial << " at " << rate;
      ASSERT_LE(table.logarithmic_slope(rate, 0.4), 1e-12) << "trial " << trial << " at " << rate;
      before = now;
    }
  }
}

TEST(ViscosityTableProperty, values_lie_between_those_of_the_neighbouring_knots) {
  RandomNumbers numbers(22);
  for (int trial = 0; trial < 400; ++trial) {
    const ViscosityTable table({random_row(numbers, false)});
    const ViscosityRow& row = table.rows().front();
    for (std::size_t i = 0; i + 1 < row.shear_rates.size(); ++i) {
      const auto [low, high] = std::minmax(row.viscosities[i], row.viscosities[i + 1]);
      for (int step = 1; step < 40; ++step) {
        const double rate =
            row.shear_rates[i] * std::pow(row.shear_rates[i + 1] / row.shear_rates[i], step / 40.0);
        const double value = table.viscosity(rate, 0.4);
        ASSERT_GE(value, low * (1 - 1e-13)) << "trial " << trial;
        ASSERT_LE(value, high * (1 + 1e-13)) << "trial " << trial;
      }
    }
  }
}

TEST(ViscosityTableProperty, value_and_slope_are_continuous_at_the_knots) {
  RandomNumbers numbers(23);
  for (int trial = 0; trial < 200; ++trial) {
    const ViscosityTable table({random_row(numbers, false)});
    const ViscosityRow& row = table.rows().front();
    for (std::size_t i = 0; i < row.shear_rates.size(); ++i) {
      const double left = row.shear_rates[i] * (1 - 1e-12);
      const double right = row.shear_rates[i] * (1 + 1e-12);
      ASSERT_NEAR(table.viscosity(left, 0.4) / table.viscosity(right, 0.4), 1, 1e-8);
      if (i == 0 || i + 1 == row.shear_rates.size()) continue;
      ASSERT_NEAR(table.logarithmic_slope(left, 0.4), table.logarithmic_slope(right, 0.4), 1e-5);
    }
  }
}

TEST(ViscosityTableProperty, scaling_the_data_scales_the_result) {
  RandomNumbers numbers(24);
  for (int trial = 0; trial < 200; ++trial) {
    const ViscosityRow row = random_row(numbers, false);
    ViscosityRow scaled = row;
    for (double& rate : scaled.shear_rates) rate *= 8;
    for (double& value : scaled.viscosities) value *= 3;
    const ViscosityTable table({row});
    const ViscosityTable other({scaled});
    const double rate = numbers.log_between(1e-3, 1e6);
    ASSERT_NEAR(other.viscosity(8 * rate, 0.4) / (3 * table.viscosity(rate, 0.4)), 1, 1e-9);
  }
}

TEST(ViscosityLawProperty, thinning_laws_thin_and_stay_between_their_plateaus) {
  RandomNumbers numbers(25);
  for (int trial = 0; trial < 500; ++trial) {
    const double mu_inf = numbers.log_between(1e-3, 1e-2);
    const double mu0 = mu_inf * numbers.log_between(1.01, 100);
    const double duration = numbers.log_between(1e-2, 1e2);
    const std::vector<ViscosityLaw> laws{
        CarreauYasuda{mu0, mu_inf, duration, numbers.between(0, 1), numbers.between(0.3, 5)},
        Cross{mu0, mu_inf, duration, numbers.between(0.2, 1.5)}};
    const double rate = numbers.log_between(1e-4, 1e6);
    for (const ViscosityLaw& law : laws) {
      const double here = law.viscosity(rate, 0.4);
      ASSERT_LE(here, mu0 * (1 + 1e-14)) << law.name();
      ASSERT_GE(here, mu_inf * (1 - 1e-14)) << law.name();
      ASSERT_LE(law.viscosity(1.1 * rate, 0.4), here * (1 + 1e-14)) << law.name();
      ASSERT_LE(law.logarithmic_slope(rate, 0.4), 0) << law.name();
    }
  }
}

TEST(ViscosityLawProperty, quemada_cokelet_thickens_with_hematocrit) {
  RandomNumbers numbers(26);
  for (int trial = 0; trial < 300; ++trial) {
    const double H = numbers.between(0.05, 0.55);
    const double rate = numbers.log_between(1, 1e4);
    ASSERT_LT(viscosity(quemada_cokelet(1.2e-3, H), rate, H),
              viscosity(quemada_cokelet(1.2e-3, H + 0.05), rate, H + 0.05))
        << H << " " << rate;
  }
}

}  // namespace
}  // namespace hemoscale::macro
