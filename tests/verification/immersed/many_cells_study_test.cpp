#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "tests/support/immersed/implicit_runs.hpp"

// Runs of full size; prints what they cost.
namespace hemoscale::micro {
namespace {

using namespace test;

constexpr double speed = 1e-3;
constexpr double height = 10 * micron;
constexpr double pitch = 12 * micron;

std::vector<Cell> row_of(int count, double first, double ratio) {
  std::vector<Cell> cells;
  for (int c = 0; c < count; ++c) {
    const double off = c % 2 == 0 ? 0.3 : -0.3;
    cells.push_back(deflated_cell({.stretch_modulus = 5e-5,
                                   .bending_modulus = 2e-19,
                                   .viscosity_ratio = ratio,
                                   .centre = {first + c * pitch, height / 2 + off * micron}}));
  }
  return cells;
}

void run(ImplicitMembranes& membranes, double duration) {
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < 10; ++k) {
    membranes.advance_by(duration / 10);
    for (std::size_t c = 0; c < membranes.cells().size(); ++c) {
      EXPECT_LT(std::abs(look_at(membranes, c).strain.area_error), 1e-6);
    }
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  const auto steps = static_cast<double>(membranes.counters().steps);
  std::printf("%zu cells: %g steps, %g refused, %.2f sweeps per step, %.1f ms per step and cell\n",
              membranes.cells().size(), steps, static_cast<double>(membranes.counters().refused),
              static_cast<double>(membranes.counters().sweeps) / steps,
              1e3 * wall.count() / steps / static_cast<double>(membranes.cells().size()));
}

TEST(ManyCells, ten_in_a_train_run_to_the_end) {
  for (const double ratio : {1.0, 5.0}) {
    ImplicitMembranes membranes(kept_channel(10 * pitch, height, 0.5 * micron, speed),
                                row_of(10, pitch / 2, ratio), {.longest_step = 1e-3});
    run(membranes, 0.06);
    EXPECT_GT(look_at(membranes, 0).shape.centroid.x(), 70 * micron);
  }
}

TEST(ManyCells, five_pass_a_constriction) {
  FlowDomain<2> domain =
      constriction_nodes(150 * micron, height, 6 * micron, 30 * micron, {.spacing = 0.5 * micron});
  give_inlet(domain, height, speed);
  ImplicitMembranes membranes(around(std::move(domain)), row_of(5, 8 * micron, 1),
                              {.longest_step = 1e-3});
  run(membranes, 0.0648);
  EXPECT_GT(look_at(membranes, 0).shape.centroid.x(), 92 * micron);
}

}  // namespace
}  // namespace hemoscale::micro
