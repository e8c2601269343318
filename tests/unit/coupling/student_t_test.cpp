#include "coupling/rheology/student_t.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hemoscale::coupling {
namespace {

// Closed forms: nu = 1 is the Cauchy law, t = tan(pi p / 2); nu = 2 has t = p sqrt(2 / (1 - p^2)).
TEST(StudentT, agrees_with_the_closed_forms_for_one_and_two_degrees_of_freedom) {
  for (const double p : {0.1, 0.5, 0.95, 0.99, 0.9999}) {
    const double pi = std::acos(-1.0);
    EXPECT_NEAR(student_t_half_width(p, 1) / std::tan(pi * p / 2), 1, 1e-9) << p;
    EXPECT_NEAR(student_t_half_width(p, 2) / (p * std::sqrt(2 / (1 - p * p))), 1, 1e-9) << p;
  }
}

// nu = 4: P(|T| <= t) = s (3 - s^2) / 2 with s = t / sqrt(4 + t^2).
TEST(StudentT, agrees_with_the_closed_form_for_four_degrees_of_freedom) {
  for (const double t : {0.5, 2.0, 7.0}) {
    const double s = t / std::sqrt(4 + t * t);
    EXPECT_NEAR(student_t_half_width(s * (3 - s * s) / 2, 4), t, 1e-8 * t);
  }
}

TEST(StudentT, approaches_the_normal_law) {
  const double normal = 1.959963984540054;  // P(|Z| <= z) = 0.95
  EXPECT_NEAR(student_t_half_width(0.95, 1e9), normal, 1e-8);
  EXPECT_NEAR(student_t_half_width(0.95, 9e6), normal, 1e-5);
  EXPECT_NEAR(student_t_half_width(0.95, 1e4), normal * (1 + (normal * normal + 1) / 4e4), 1e-6);
}

TEST(StudentT, holds_for_fractional_degrees_of_freedom) {
  const double t = student_t_half_width(0.95, 2.5);
  EXPECT_LT(t, student_t_half_width(0.95, 2));
  EXPECT_GT(t, student_t_half_width(0.95, 3));
}

TEST(StudentT, without_freedom_there_is_no_statement) {
  EXPECT_TRUE(std::isinf(student_t_half_width(0.95, 0)));
  EXPECT_TRUE(std::isinf(student_t_half_width(0.95, std::nan(""))));
}

TEST(Sidak, independent_intervals_hold_together_with_the_wanted_probability) {
  EXPECT_NEAR(std::pow(sidak_probability(0.95, 7), 7), 0.95, 1e-14);
  EXPECT_EQ(sidak_probability(0.95, 1), 0.95);
}

}  // namespace
}  // namespace hemoscale::coupling
