#include <gtest/gtest.h>

#include "tests/support/immersed/parachutes.hpp"

// Two of the reference cells at l0 = D / 20; all of them in parachute_study_test.cpp.
namespace hemoscale::micro {
namespace {

using namespace test;

void expect_parachute(std::size_t row) {
  const ParachuteCase c = parachute_case(row);
  const Parachute p = run_parachute(c, {.travel = 60 * micron});
  EXPECT_NEAR(p.speed, c.known.speed, 0.001 * c.known.speed);
  EXPECT_NEAR(p.drop, c.known.drop, 0.02 * c.known.drop);
  EXPECT_NEAR(p.gap, c.known.gap, 0.01 * c.known.gap);
  EXPECT_LT(p.shape_distance, 0.03 * micron);
}

TEST(Parachute, of_a_stiff_cell_is_that_of_the_reference) {
  expect_parachute(1);
}

TEST(Parachute, of_a_deflated_cell_is_that_of_the_reference) {
  expect_parachute(4);
}

}  // namespace
}  // namespace hemoscale::micro
