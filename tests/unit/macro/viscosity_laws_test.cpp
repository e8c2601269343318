#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "macro/error.hpp"
#include "macro/viscosity/kinks.hpp"
#include "macro/viscosity/viscosity_law.hpp"

namespace hemoscale::macro {
namespace {

const std::vector<double> rates{1e-4, 1e-2, 0.3, 1, 5, 40, 300, 1e4, 1e7};  // [1/s]

TEST(Newtonian, is_constant) {
  const Newtonian law{1.2e-3};
  for (const double rate : rates) EXPECT_EQ(viscosity(law, rate, 0.4), 1.2e-3);
}

// The law solved for the shear rate.
TEST(CarreauYasuda, satisfies_its_equation) {
  const CarreauYasuda law{22e-3, 2.2e-3, 0.11, 0.392, 0.644};
  for (const double rate : {0.3, 1.0, 5.0, 40.0, 300.0, 1e4}) {
    const double thinned = (viscosity(law, rate, 0) - law.mu_inf) / (law.mu0 - law.mu_inf);
    const double x = std::pow(thinned, law.transition / (law.power - 1)) - 1;
    EXPECT_NEAR(std::pow(x, 1 / law.transition) / law.time, rate, 1e-9 * rate);
  }
}

TEST(CarreauYasuda, has_two_plateaus_and_a_power_law_between) {
  const CarreauYasuda law{1, 1e-12, 1, 0.3, 2};
  EXPECT_EQ(viscosity(law, 0, 0), 1);
  EXPECT_NEAR(viscosity(law, 1e4, 0), std::pow(1e4, -0.7), 1e-9);
  EXPECT_NEAR(logarithmic_slope(law, 1e4, 0), -0.7, 1e-6);
  EXPECT_NEAR(viscosity(cho_kensey_1991(), 1e15, 0), 3.45e-3, 1e-11);
}

TEST(CarreauYasuda, does_not_overflow_where_its_value_is_finite) {
  const CarreauYasuda law{56e-3, 3.45e-3, 3.313, 0.3568, 2};
  EXPECT_EQ(viscosity(law, 1e300, 0), law.mu_inf);
}

TEST(Casson, satisfies_its_equation_above_the_lowest_shear_rate) {
  const Casson law{5e-3, 3.5e-3, 1e-3};
  for (const double rate : {1e-3, 0.3, 1.0, 40.0, 1e4}) {
    const double stress = rate * viscosity(law, rate, 0);
    EXPECT_NEAR(std::sqrt(stress), std::sqrt(5e-3) + std::sqrt(3.5e-3 * rate),
                1e-14 * std::sqrt(stress));
  }
}

TEST(Casson, is_held_below_the_lowest_shear_rate) {
  const Casson law{5e-3, 3.5e-3, 1e-3};
  EXPECT_EQ(viscosity(law, 0, 0), viscosity(law, 1e-3, 0));
  EXPECT_EQ(viscosity(law, 0.999e-3, 0), viscosity(law, 1e-3, 0));
  EXPECT_LT(viscosity(law, 1.001e-3, 0), viscosity(law, 1e-3, 0));
  EXPECT_EQ(logarithmic_slope(law, 0.999e-3, 0), 0);
  EXPECT_LT(logarithmic_slope(law, 1e-3, 0), 0);
}

TEST(Cross, is_halfway_between_the_plateaus_where_time_times_rate_is_one) {
  const Cross law{10, 2, 0.5, 0.8};
  EXPECT_EQ(viscosity(law, 0, 0), 10);
  EXPECT_NEAR(viscosity(law, 2, 0), 6, 1e-14);
  EXPECT_NEAR(viscosity(law, 1e30, 0), 2, 1e-14);
}

TEST(Cross, satisfies_its_equation) {
  const Cross law{56e-3, 3.45e-3, 3.736, 0.718};
  for (const double rate : rates) {
    const double ratio =
        (law.mu0 - viscosity(law, rate, 0)) / (viscosity(law, rate, 0) - law.mu_inf);
    EXPECT_NEAR(ratio / std::pow(law.time * rate, law.power), 1, 1e-9);
  }
}

TEST(Cross, thickens_if_the_second_plateau_is_the_higher) {
  const Cross law{0.01, 10, 0.4, 3};
  EXPECT_LT(viscosity(law, 1, 0), viscosity(law, 2, 0));
  EXPECT_GT(logarithmic_slope(law, 1, 0), 0);
}

TEST(PowerLaw, is_a_power_inside_its_bounds_and_held_outside) {
  const PowerLaw law{0.014, 0.6, 0.1, 100};
  EXPECT_NEAR(viscosity(law, 1, 0), 0.014, 1e-16);
  EXPECT_NEAR(viscosity(law, 32, 0), 0.014 * std::pow(32, -0.4), 1e-16);
  EXPECT_EQ(viscosity(law, 0, 0), viscosity(law, 0.1, 0));
  EXPECT_EQ(viscosity(law, 1e9, 0), viscosity(law, 100, 0));
  EXPECT_EQ(logarithmic_slope(law, 0.099, 0), 0);
  EXPECT_NEAR(logarithmic_slope(law, 0.1, 0), -0.4, 1e-15);
  EXPECT_NEAR(logarithmic_slope(law, 100, 0), -0.4, 1e-15);
  EXPECT_EQ(logarithmic_slope(law, 100.1, 0), 0);
}

// With A = 1 - k0 H / 2, B = 1 - k_inf H / 2 the law is identical to
// sqrt(mu) = sqrt(mu_inf) + sqrt(tau_0) / (sqrt(Lambda) + sqrt(g)).
TEST(Quemada, equals_its_generalised_casson_form) {
  const Quemada law{1.2e-3, 4.33, 2.07, 1.88};
  const double H = 0.45;
  const double A = 1 - 0.5 * law.k0 * H;
  const double B = 1 - 0.5 * law.k_inf * H;
  const double root_mu_inf = std::sqrt(law.plasma_viscosity) / B;
  const double root_lambda = A / B * std::sqrt(law.critical_shear_rate);
  const double root_tau = root_mu_inf * (1 - A / B) * std::sqrt(law.critical_shear_rate);
  for (const double rate : rates) {
    const double root = root_mu_inf + root_tau / (root_lambda + std::sqrt(rate));
    EXPECT_NEAR(viscosity(law, rate, H), root * root, 1e-11 * root * root) << rate;
  }
}

TEST(Quemada, is_plasma_without_cells) {
  const Quemada law{1.2e-3, 4.33, 2.07, 1.88};
  EXPECT_EQ(viscosity(law, 1, 0), 1.2e-3);
}

TEST(Quemada, refuses_packed_cells_and_accepts_just_below) {
  const Quemada law{1.2e-3, 4, 2, 1};
  EXPECT_GT(viscosity(law, 0, 0.4999), 1e3 * 1.2e-3);
  EXPECT_THROW(viscosity(law, 0, 0.5), ParameterError);
  EXPECT_THROW(logarithmic_slope(law, 0, 0.5), ParameterError);
  EXPECT_NO_THROW(viscosity(law, 1, 0.5));  // k = 3 there: packed at 2 / 3
  EXPECT_THROW(viscosity(law, 1, -0.01), ParameterError);
}

TEST(QuemadaCokelet, gives_the_intrinsic_viscosities_of_its_polynomials) {
  const Quemada at_zero = quemada_cokelet(1.2e-3, 0);
  EXPECT_NEAR(at_zero.k0, std::exp(3.874), 1e-12);
  EXPECT_NEAR(at_zero.k_inf, std::exp(1.3435), 1e-12);
  EXPECT_NEAR(at_zero.critical_shear_rate, std::exp(-6.1508), 1e-15);
  const Quemada at_half = quemada_cokelet(1.2e-3, 0.5);
  EXPECT_NEAR(std::log(at_half.k0), 3.874 - 5.205 + 3.45 - 0.84225, 1e-12);
  EXPECT_NEAR(std::log(at_half.k_inf), 1.3435 - 1.4015 + 0.67775 - 0.0809875, 1e-12);
  EXPECT_NEAR(std::log(at_half.critical_shear_rate), -6.1508 + 13.9615 - 6.4 + 0.462125, 1e-12);
}

// Measured bands for blood at hematocrit 0.45 (Chien 1970): about 4 times plasma at 100 1/s.
TEST(QuemadaCokelet, gives_blood_four_times_the_viscosity_of_plasma_at_100_per_second) {
  const double ratio = viscosity(quemada_cokelet(1.2e-3, 0.45), 100, 0.45) / 1.2e-3;
  EXPECT_NEAR(ratio, 4, 0.8);
}

TEST(QuemadaCokelet, refuses_hematocrits_beyond_its_measurements) {
  EXPECT_NO_THROW(quemada_cokelet(1.2e-3, 0.6));
  EXPECT_THROW(quemada_cokelet(1.2e-3, 0.601), ParameterError);
  EXPECT_THROW(quemada_cokelet(1.2e-3, -0.001), ParameterError);
  EXPECT_THROW(quemada_cokelet(0, 0.4), ParameterError);
}

struct Subject {
  ViscosityLaw law;
  std::string name;
};

void PrintTo(const Subject& subject, std::ostream* out) {
  *out << subject.name;
}

class EveryLaw : public testing::TestWithParam<Subject> {};

TEST_P(EveryLaw, slope_is_the_derivative_in_logarithms) {
  const ViscosityLaw& law = GetParam().law;
  const double step = 1e-4;
  for (const double rate : {3e-3, 0.7, 3.0, 45.0, 400.0, 9e3}) {
    const auto log_viscosity = [&](double shift) {
      return std::log(law.viscosity(rate * std::exp(shift), 0.4));
    };
    const double difference = (8 * (log_viscosity(step) - log_viscosity(-step)) -
                               (log_viscosity(2 * step) - log_viscosity(-2 * step))) /
                              (12 * step);
    EXPECT_NEAR(law.logarithmic_slope(rate, 0.4), difference, 1e-10) << rate;
  }
}

TEST_P(EveryLaw, is_finite_and_positive_from_rest_to_any_shear_rate) {
  const ViscosityLaw& law = GetParam().law;
  for (const double rate : {0.0, 1e-300, 1e-9, 1.0, 1e9, 1e200}) {
    EXPECT_GT(law.viscosity(rate, 0.4), 0) << rate;
    EXPECT_TRUE(std::isfinite(law.viscosity(rate, 0.4))) << rate;
    EXPECT_TRUE(std::isfinite(law.logarithmic_slope(rate, 0.4))) << rate;
  }
  EXPECT_EQ(law.logarithmic_slope(0, 0.4), 0);
}

TEST_P(EveryLaw, passes_a_shear_rate_that_is_not_a_number_on) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const bool looks_at_it = GetParam().name != "newtonian";
  EXPECT_EQ(std::isnan(GetParam().law.viscosity(nan, 0.4)), looks_at_it);
}

TEST_P(EveryLaw, has_its_name) {
  EXPECT_EQ(GetParam().law.name(), GetParam().name);
}

ViscosityTable two_rows() {
  return ViscosityTable({{0.2, {0.1, 1, 10, 100}, {9e-3, 6e-3, 3e-3, 2e-3}},
                         {0.45, {0.2, 2, 20}, {30e-3, 10e-3, 5e-3}}});
}

INSTANTIATE_TEST_SUITE_P(Laws, EveryLaw,
                         testing::Values(Subject{Newtonian{1.2e-3}, "newtonian"},
                                         Subject{cho_kensey_1991(), "carreau_yasuda"},
                                         Subject{Casson{5e-3, 3.5e-3, 2e-3}, "casson"},
                                         Subject{Cross{56e-3, 3.45e-3, 3.736, 0.718}, "cross"},
                                         Subject{PowerLaw{0.014, 0.6, 1e-3, 1e4}, "power_law"},
                                         Subject{quemada_cokelet(1.2e-3, 0.4), "quemada"},
                                         Subject{two_rows(), "table"}),
                         [](const auto& subject) { return subject.param.name; });

TEST(Kinks, lie_where_values_begin_to_be_held_and_at_knots) {
  EXPECT_TRUE(kinks(Newtonian{1}).empty());
  EXPECT_EQ(kinks(Casson{5e-3, 3.5e-3, 2e-3}), std::vector<double>({2e-3}));
  EXPECT_EQ(kinks(PowerLaw{1, 0.5, 1e-3, 1e3}), std::vector<double>({1e-3, 1e3}));
  EXPECT_EQ(kinks(two_rows()), std::vector<double>({0.1, 0.2, 1, 2, 10, 20, 100}));
}

}  // namespace
}  // namespace hemoscale::macro
