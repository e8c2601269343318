#include "micro/immersed/surrounding_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/immersed/implicit_runs.hpp"

namespace hemoscale::micro {
namespace {

using namespace test;

constexpr double height = 10 * micron;
constexpr double speed = 1e-3;

/// A deformed cell on its way, between walls.
ImplicitMembranes moving_cell(std::shared_ptr<const Surroundings> around, double length,
                              double ratio, double duration) {
  const CellPlan plan{.nodes = 59,
                      .stretch_modulus = 5e-5,
                      .bending_modulus = 2e-18,
                      .viscosity_ratio = ratio,
                      .angle = 1,
                      .centre = {0.4 * length, 4.6 * micron}};
  ImplicitMembranes membranes(std::move(around), {deflated_cell(plan)},
                              {.longest_step = 1e-3, .sweep_tolerance = 1e-7});
  membranes.advance_by(duration);
  return membranes;
}

/// Through the channel at x, by Simpson's rule.
double flow_rate(const MembraneFlow& flow, double x) {
  constexpr int count = 80;
  std::vector<Vector<2>> places;
  for (int i = 0; i <= count; ++i) places.emplace_back(x, height * i / count);
  const FlowValues values = flow.at(places);
  double sum = 0;
  for (int i = 0; i <= count; ++i) {
    const double weight = i == 0 || i == count ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * values.velocities[static_cast<std::size_t>(i)].x();
  }
  return sum * height / (3 * count);
}

// By the reciprocal theorem the growth of the drive is known from the membrane alone; that it keeps
// the flow rate is seen from the whole flow.
TEST(Surroundings, keep_the_flow_rate_whatever_is_inside_the_cell) {
  const double wanted = speed * height;
  for (const double ratio : {1.0, 5.0}) {
    const auto around = kept_channel(30 * micron, height, 0.5 * micron, speed);
    const ImplicitMembranes membranes = moving_cell(around, 30 * micron, ratio, 2e-3);
    const MembraneFlow flow(membranes);
    const auto free_channel = kept_channel(30 * micron, height, 0.5 * micron, speed, false);
    const Surroundings::Reaction free = free_channel->reaction(membranes.sources());
    const Surroundings::Reaction kept = around->reaction(membranes.sources());
    EXPECT_EQ(free.extra_drive, 0);
    EXPECT_GT(kept.extra_drive, 0.01);
    for (const double x : {1 * micron, 26 * micron}) {
      EXPECT_NEAR(flow_rate(flow, x) / wanted, 1, 1e-4) << ratio;
    }
    if (ratio == 1) {
      // Through the cell as well: nothing is lost in it.
      const double middle = look_at(membranes).shape.centroid.x();
      EXPECT_NEAR(flow_rate(flow, middle) / wanted, 1, 2e-3);
    }
    EXPECT_NEAR(flow.extra_pressure_drop(), kept.extra_drive * around->driving_pressure(), 1e-12);
  }
}

TEST(MembraneFlow, has_the_same_pressure_drop_between_openings_as_over_a_period) {
  for (const double ratio : {1.0, 5.0}) {
    const double length = 50 * micron;
    std::vector<double> drops;
    for (const bool is_periodic : {true, false}) {
      const auto around = is_periodic ? kept_channel(length, height, 0.5 * micron, speed)
                                      : open_channel(length, height, 0.5 * micron, speed);
      const ImplicitMembranes membranes = moving_cell(around, length, ratio, 2e-3);
      drops.push_back(MembraneFlow(membranes).extra_pressure_drop());
    }
    EXPECT_NEAR(drops[1] / drops[0], 1, 2e-3) << ratio;
  }
}

// The velocity is continuous across a membrane, and that of its nodes.
TEST(MembraneFlow, goes_with_the_membrane_on_both_sides) {
  for (const double ratio : {1.0, 5.0, 0.2}) {
    const ImplicitMembranes membranes = moving_cell(
        kept_channel(30 * micron, height, 0.5 * micron, speed), 30 * micron, ratio, 2e-3);
    const MembraneFlow flow(membranes);
    const Cell& cell = membranes.cells()[0];
    const RingContour ring = RingQuadrature(cell.positions.size()).contour(cell.positions);
    for (const double side : {1.0, -1.0}) {
      // From two distances straight to the membrane.
      std::vector<Vector<2>> near, far;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        near.emplace_back(ring.positions[i] + side * 0.4 * ring.lengths[i] * ring.normals[i]);
        far.emplace_back(ring.positions[i] + side * 0.8 * ring.lengths[i] * ring.normals[i]);
      }
      const FlowValues at_near = flow.at(near);
      const FlowValues at_far = flow.at(far);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vector<2> u = 2 * at_near.velocities[i] - at_far.velocities[i];
        EXPECT_LT((u - cell.velocities[i]).norm(), 0.05 * speed) << ratio << ", node " << i;
      }
    }
  }
}

// mu lap u = grad p outside, lambda mu lap u = grad p inside.
TEST(MembraneFlow, is_of_stokes_on_both_sides) {
  const double ratio = 5;
  const ImplicitMembranes membranes = moving_cell(shear(200), 0, ratio, 5e-3);
  const MembraneFlow flow(membranes);
  const Vector<2> centre = look_at(membranes).shape.centroid;
  constexpr double h = 0.05 * micron;
  struct Place {
    Vector<2> x;
    double viscosity;
  };
  const double mu = water.viscosity();
  for (const Place& place : {Place{centre + Vector<2>(0.2, 0.1) * micron, ratio * mu},
                             Place{centre + Vector<2>(1, 4) * micron, mu}}) {
    const Vector<2> dx(h, 0);
    const Vector<2> dy(0, h);
    const FlowValues v = flow.at({place.x + dx, place.x - dx, place.x + dy, place.x - dy, place.x});
    const Vector<2> laplacian = (v.velocities[0] + v.velocities[1] + v.velocities[2] +
                                 v.velocities[3] - 4 * v.velocities[4]) /
                                (h * h);
    const Vector<2> slope((v.pressures[0] - v.pressures[1]) / (2 * h),
                          (v.pressures[2] - v.pressures[3]) / (2 * h));
    EXPECT_LT((place.viscosity * laplacian - slope).norm(), 0.01 * slope.norm());
    EXPECT_GT(slope.norm(), 0);
  }
}

}  // namespace
}  // namespace hemoscale::micro
