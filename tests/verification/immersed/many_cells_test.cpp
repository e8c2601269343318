#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/immersed/implicit_runs.hpp"

namespace hemoscale::micro {
namespace {

using namespace test;

constexpr double speed = 1e-3;
constexpr double height = 10 * micron;
constexpr double pitch = 12 * micron;

std::vector<Cell> row_of(int count, int nodes, double first) {
  std::vector<Cell> cells;
  for (int c = 0; c < count; ++c) {
    const double off = 0.3;
    cells.push_back(deflated_cell({.nodes = nodes,
                                   .stretch_modulus = 5e-5,
                                   .bending_modulus = 2e-19,
                                   .centre = {first + c * pitch, height / 2 + off * micron}}));
  }
  return cells;
}

double largest_area_error(const ImplicitMembranes& membranes) {
  double largest = 0;
  for (std::size_t c = 0; c < membranes.cells().size(); ++c) {
    largest = std::max(largest, std::abs(look_at(membranes, c).strain.area_error));
  }
  return largest;
}

// Ten cells that feel each other are one that feels its images.
TEST(ManyCells, train_of_ten_is_a_train_of_one_repeated) {
  std::vector<ImplicitMembranes> trains;
  for (const int count : {10, 1}) {
    trains.emplace_back(kept_channel(count * pitch, height, 0.8 * micron, speed),
                        row_of(count, 40, pitch / 2), ImplicitOptions{.longest_step = 1e-3});
    trains.back().advance_by(0.03);
    EXPECT_LT(largest_area_error(trains.back()), 1e-6);
    EXPECT_LT(static_cast<double>(trains.back().counters().sweeps),
              4.0 * static_cast<double>(trains.back().counters().steps));
  }
  const Vector<2> velocity = look_at(trains[1], 0).motion.velocity;
  for (std::size_t c = 0; c < 10; ++c) {
    EXPECT_LT((look_at(trains[0], c).motion.velocity - velocity).norm(), 1e-3 * speed);
  }
  EXPECT_GT(velocity.x(), 1.25 * speed);
}

// From 10 um through 6 um, and out again.
TEST(ManyCells, pass_a_constriction) {
  const double length = 90 * micron;
  FlowDomain<2> domain =
      constriction_nodes(length, height, 6 * micron, 30 * micron, {.spacing = 0.5 * micron});
  give_inlet(domain, height, speed);
  ImplicitMembranes membranes(around(std::move(domain)), row_of(2, 40, 8 * micron),
                              {.longest_step = 1e-3});
  double narrowest = height;
  double least_area = 1;
  for (int k = 0; k < 20; ++k) {
    membranes.advance_by(2e-3);
    for (const std::size_t c : {0U, 1U}) {
      narrowest = std::min(narrowest, look_at(membranes, c).shape.width);
    }
    least_area = std::min(least_area, largest_area_error(membranes));
    EXPECT_LT(largest_area_error(membranes), 1e-6);
  }
  EXPECT_LT(narrowest, 4.2 * micron);  // it was squeezed
  EXPECT_GT(look_at(membranes, 1).shape.centroid.x(), 70 * micron);
  EXPECT_GT(look_at(membranes, 0).shape.centroid.x(), 45 * micron);
}

}  // namespace
}  // namespace hemoscale::micro
