#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/immersed/implicit_runs.hpp"

namespace hemoscale::micro {
namespace {

using namespace test;
using Points = std::vector<Vector<2>>;

double distance(const Points& a, const Points& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

constexpr double rate = 100;

/// An ellipse that relaxes while the shear turns it.
Points relaxed(double ratio, const ImplicitOptions& options, double duration) {
  Points ellipse = circle(3 * micron, 40);
  for (Vector<2>& x : ellipse) x = {1.4 * x.x(), 0.6 * x.y()};
  const CellPlan plan{.nodes = 40,
                      .stretch_modulus = 1e-5,
                      .bending_modulus = 5e-19,
                      .viscosity_ratio = ratio,
                      .angle = 1};
  ImplicitMembranes membranes(shear(rate), {cell_of(ellipse, plan)}, options);
  membranes.advance_by(duration);
  return membranes.cells()[0].positions;
}

/// The way from the rest shape to the parachute.
Points starting(const ImplicitOptions& options, double duration) {
  const CellPlan plan{.nodes = 40,
                      .stretch_modulus = 5e-5,
                      .bending_modulus = 2e-18,
                      .centre = {10 * micron, 5 * micron}};
  static const auto around = kept_channel(20 * micron, 10 * micron, 1 * micron, 1e-3);
  ImplicitMembranes membranes(around, {deflated_cell(plan)}, options);
  membranes.advance_by(duration);
  return membranes.cells()[0].positions;
}

void expect_second_order(const char* name, const std::function<Points(double step)>& solve,
                         double step) {
  const Points middle = solve(step / 2);
  const Points fine = solve(step / 4);
  const Points finest = solve(step / 8);
  const double next = std::log2(distance(middle, fine) / distance(fine, finest));
  EXPECT_GT(next, 1.8) << name;
  EXPECT_LT(next, 2.6) << name;
}

ImplicitOptions steps_of(double dt) {
  return {.longest_step = dt, .step_tolerance = 0, .sweep_tolerance = 1e-9};
}

TEST(ImplicitTimeOrder, is_two_for_a_cell_that_relaxes_in_shear) {
  for (const double ratio : {1.0, 5.0}) {
    expect_second_order(
        "shear", [&](double dt) { return relaxed(ratio, steps_of(dt), 1 / rate); }, 0.04 / rate);
  }
}

TEST(ImplicitTimeOrder, is_two_for_a_cell_that_becomes_a_parachute) {
  expect_second_order(
      "parachute", [](double dt) { return starting(steps_of(dt), 2e-3); }, 1e-4);
}

// The tolerance bounds what a step may add; the error at the end falls with its power 2/3.
TEST(ImplicitTimeOrder, error_follows_the_tolerance_of_the_steps) {
  const double duration = 3 / rate;
  const Points exact = relaxed(1, steps_of(5e-4 / rate), duration);
  double before = 0;
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    const double error = distance(
        relaxed(1, {.longest_step = 0.2 / rate, .step_tolerance = tolerance}, duration), exact);
    if (before > 0) {
      EXPECT_LT(error, 0.35 * before);
    }
    before = error;
  }
  EXPECT_LT(before, 0.01 * micron);
}

}  // namespace
}  // namespace hemoscale::micro
