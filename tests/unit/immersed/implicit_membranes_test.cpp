#include "micro/immersed/implicit_membranes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "micro/error.hpp"
#include "tests/support/immersed/implicit_runs.hpp"

namespace hemoscale::micro {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using namespace test;

constexpr double rate = 100;  // [1/s]
const CellPlan soft{.nodes = 40, .bending_modulus = 2e-19};

/// Squeezes along x, draws along y.
std::shared_ptr<const Surroundings> squeeze() {
  UnboundedFlow flow{.viscosity = water.viscosity()};
  flow.gradient(0, 0) = -rate;
  flow.gradient(1, 1) = rate;
  return std::make_shared<Surroundings>(flow);
}

template <typename Act>
std::string message_of(const Act& act) {
  try {
    act();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

std::string refusal(std::shared_ptr<const Surroundings> around, std::vector<Cell> cells,
                    const ImplicitOptions& options = {.longest_step = 1e-4}) {
  EXPECT_THROW(ImplicitMembranes(around, cells, options), ParameterError);
  return message_of([&] { ImplicitMembranes(around, cells, options); });
}

TEST(ImplicitMembranes, refuses_cells_that_are_not_admissible) {
  const auto around = shear(rate);
  const Cell good = deflated_cell(soft);
  Cell bad = good;
  bad.membrane = nullptr;
  EXPECT_THAT(refusal(around, {good, bad}), HasSubstr("cell 1 has no membrane"));
  bad = good;
  bad.positions.pop_back();
  EXPECT_THAT(refusal(around, {bad}), HasSubstr("39 positions for the 40 nodes"));
  bad = good;
  bad.viscosity_ratio = 0;
  EXPECT_THAT(refusal(around, {bad}), HasSubstr("viscosity ratio is 0; it must be positive"));
  CellPlan plan = soft;
  plan.stretch_modulus = 1e-5;
  bad = deflated_cell(plan);
  MembraneParameters p = bad.membrane->parameters();
  p.stretch_modulus = 0;
  bad.membrane = std::make_shared<RingMembrane>(bad.membrane->mesh(), p);
  EXPECT_THAT(refusal(around, {bad}), HasSubstr("stretch modulus is 0 N/m; it must be positive"));
  bad = good;
  std::reverse(bad.positions.begin(), bad.positions.end());
  EXPECT_THAT(refusal(around, {bad}), HasSubstr("cell 0: runs clockwise"));
  bad = good;
  std::swap(bad.positions[3], bad.positions[20]);
  EXPECT_THAT(refusal(around, {bad}), HasSubstr("cell 0: crosses itself"));
  bad = good;
  for (Vector<2>& x : bad.positions) x.x() += 0.1 * micron;
  EXPECT_THAT(refusal(around, {good, bad}), HasSubstr("cell 0 overlaps cell 1"));
  EXPECT_THAT(refusal(around, {cell_of(circle(3 * micron, 40), soft)}),
              HasSubstr("encloses all the area that it can"));
  EXPECT_THAT(refusal(around, {good}, {.longest_step = 0}), HasSubstr("longest step"));
  EXPECT_THAT(refusal(around, {good}, {.longest_step = 1e-4, .step_tolerance = -1}),
              HasSubstr("not negative"));
}

TEST(ImplicitMembranes, refuses_cells_that_do_not_lie_in_the_fluid) {
  const auto around = open_channel(24 * micron, 10 * micron, 1 * micron, 1e-3);
  CellPlan plan = soft;
  plan.centre = {12 * micron, 1 * micron};
  EXPECT_THAT(refusal(around, {deflated_cell(plan)}), HasSubstr("beyond a wall"));
  plan.centre = {1.2 * micron, 5 * micron};
  EXPECT_THAT(refusal(around, {deflated_cell(plan)}), HasSubstr("from an opening"));
}

// The image of a cell lies in the way of another one, whichever node is the first of each.
TEST(ImplicitMembranes, refuses_cells_that_overlap_across_the_joint) {
  const auto around = kept_channel(16 * micron, 10 * micron, 1 * micron, 1e-3);
  CellPlan plan = soft;
  plan.centre = {2 * micron, 5 * micron};
  const Cell one = deflated_cell(plan);
  plan.centre = {17 * micron, 5 * micron};
  EXPECT_THAT(refusal(around, {one, deflated_cell(plan)}), HasSubstr("overlaps"));
}

TEST(Surroundings, refuse_flows_that_are_not_admissible) {
  UnboundedFlow flow{.viscosity = 0};
  EXPECT_THROW(Surroundings{flow}, ParameterError);
  flow.viscosity = 1e-3;
  flow.gradient(0, 0) = 1;
  EXPECT_THAT(message_of([&] { Surroundings{flow}; }), HasSubstr("without trace"));
  FlowDomain<2> box = periodic_nodes<2>({10 * micron, 10 * micron}, {.spacing = 1 * micron});
  EXPECT_THROW(around(std::move(box)), std::runtime_error);
}

TEST(ImplicitMembranes, refuse_a_duration_that_is_not_positive) {
  ImplicitMembranes membranes(shear(rate), {deflated_cell(soft)}, {.longest_step = 1e-4});
  EXPECT_THROW(membranes.advance_by(0), ParameterError);
  EXPECT_THROW(membranes.advance_by(-1e-3), ParameterError);
}

TEST(ImplicitMembranes, without_cells_let_time_pass) {
  ImplicitMembranes membranes(shear(rate), {}, {.longest_step = 1e-4});
  membranes.advance_by(3e-3);
  EXPECT_EQ(membranes.time(), 3e-3);
}

TEST(ImplicitMembranes, stop_at_the_wanted_times) {
  for (const double tolerance : {0.0, 0.003}) {
    ImplicitMembranes membranes(shear(rate), {deflated_cell(soft)},
                                {.longest_step = 1e-4, .step_tolerance = tolerance});
    membranes.advance_by(0.00123);
    EXPECT_EQ(membranes.time(), 0.00123);
    membranes.advance_by(1e-5);
    EXPECT_EQ(membranes.time(), 0.00123 + 1e-5);
    // After a short step the next ones grow by no more than a factor of 1.8.
    membranes.advance_by(1e-3);
    EXPECT_GE(membranes.counters().steps, 12 + 1 + 12);
    EXPECT_LE(membranes.last_step(), 1e-4);
  }
}

/// A failure leaves the cells as they were after the last good step.
void expect_failure(ImplicitMembranes& membranes, double duration, const std::string& cell,
                    const std::string& what, const std::string& remedy) {
  const double each = duration / 200;
  for (int k = 0; k < 200; ++k) {
    const std::vector<Cell> cells = membranes.cells();
    const double time = membranes.time();
    const std::int64_t steps = membranes.counters().steps;
    try {
      membranes.advance_by(each);
    } catch (const NumericalError& error) {
      const std::string step = "step " + std::to_string(membranes.counters().steps + 1) + ", time ";
      EXPECT_THAT(error.what(),
                  AllOf(HasSubstr(step), HasSubstr(cell), HasSubstr(what), HasSubstr(remedy)));
      if (membranes.counters().steps == steps) {
        EXPECT_EQ(membranes.time(), time);
        for (std::size_t c = 0; c < cells.size(); ++c) {
          EXPECT_EQ(membranes.cells()[c].positions, cells[c].positions);
          EXPECT_EQ(membranes.cells()[c].velocities, cells[c].velocities);
        }
      }
      for (const Cell& each_cell : membranes.cells()) {
        for (const Vector<2>& x : each_cell.positions) ASSERT_TRUE(x.allFinite());
      }
      return;
    }
  }
  ADD_FAILURE() << "no failure: " << what;
}

TEST(ImplicitFailure, names_the_opening_that_a_cell_runs_into) {
  CellPlan plan = soft;
  plan.centre = {12 * micron, 5 * micron};
  ImplicitMembranes membranes(open_channel(24 * micron, 10 * micron, 1 * micron, 1e-3),
                              {deflated_cell(plan)}, {.longest_step = 5e-4, .step_tolerance = 0});
  expect_failure(membranes, 0.1, "cell 0: node ", "m from an opening", "lengthen the channel");
  EXPECT_GT(membranes.cells()[0].positions[0].x(), 15 * micron);
}

TEST(ImplicitFailure, names_the_wall_that_a_cell_runs_into) {
  CellPlan plan{.nodes = 40, .stretch_modulus = 1e-6, .bending_modulus = 2e-20};
  plan.centre = {12 * micron, 3.95 * micron};
  // Steps so long that the cell passes the whole gap in one.
  ImplicitMembranes membranes(kept_channel(24 * micron, 10 * micron, 1 * micron, 0.2),
                              {deflated_cell(plan)},
                              {.longest_step = 1e-3, .step_tolerance = 0, .sweep_tolerance = 10});
  expect_failure(membranes, 1, "cell 0: ", "beyond a wall", "refine the particles");
}

TEST(ImplicitFailure, names_the_cell_that_a_cell_runs_into) {
  CellPlan plan = soft;
  plan.centre = {-3 * micron, 0};
  const Cell left = deflated_cell(plan);
  plan.centre = {3 * micron, 0};
  ImplicitMembranes membranes(
      squeeze(), {left, deflated_cell(plan)},
      {.longest_step = 0.5 / rate, .step_tolerance = 0, .sweep_tolerance = 10});
  expect_failure(membranes, 100 / rate, "cell 0: it runs into cell 1 near (",
                 "the gap between them is not resolved", "more nodes, or shorten the step");
}

TEST(ImplicitFailure, names_the_segments_at_which_a_cell_crosses_itself) {
  CellPlan plan = soft;
  plan.reduced_area = 0.30;
  ImplicitMembranes membranes(shear(rate), {deflated_cell(plan)},
                              {.longest_step = 1 / rate, .step_tolerance = 0});
  expect_failure(membranes, 200 / rate, "cell 0: its outline crosses itself near (", "segments ",
                 "more nodes or a larger bending modulus, or shorten the step");
}

TEST(ImplicitFailure, names_the_sweeps_that_did_not_suffice) {
  CellPlan plan = soft;
  plan.centre = {12 * micron, 5 * micron};
  ImplicitMembranes membranes(
      kept_channel(24 * micron, 10 * micron, 1 * micron, 1e-3), {deflated_cell(plan)},
      {.longest_step = 1e-4, .step_tolerance = 0, .sweep_tolerance = 1e-9, .most_sweeps = 2});
  expect_failure(membranes, 0.02, "cells and walls did not agree on the flow in 2 sweeps",
                 "wanted 1e-09", "shorten the step");
}

TEST(ImplicitFailure, names_the_strain_and_the_area) {
  CellPlan plan{.nodes = 40, .stretch_modulus = 1e-7, .bending_modulus = 2e-20};
  const Cell cell = deflated_cell(plan);
  ImplicitOptions options{.longest_step = 0.2 / rate, .step_tolerance = 0};
  options.thresholds.strain = 0.4;
  ImplicitMembranes stretched(squeeze(), {cell}, options);
  expect_failure(stretched, 100 / rate, "cell 0: the strain of segment ", "at most 0.4",
                 "larger stretch modulus");
  Cell leaky = cell;
  MembraneParameters p = cell.membrane->parameters();
  p.area_law = AreaLaw::penalty;
  p.area_modulus = 1e-4;
  leaky.membrane = std::make_shared<RingMembrane>(cell.membrane->mesh(), p);
  options.thresholds = {.strain = 100, .area = 1e-6};
  ImplicitMembranes swelling(squeeze(), {leaky}, options);
  expect_failure(swelling, 100 / rate, "cell 0: its area is off by ", "at most 1e-06",
                 "keep it exactly");
}

// Steps of free length are shortened first; what shorter ones do not cure is said then.
TEST(ImplicitFailure, that_no_shorter_step_avoids_ends) {
  CellPlan plan = soft;
  plan.centre = {12 * micron, 5 * micron};
  ImplicitMembranes membranes(open_channel(24 * micron, 10 * micron, 1 * micron, 1e-3),
                              {deflated_cell(plan)}, {.longest_step = 1e3});
  EXPECT_THAT(message_of([&] { membranes.advance_by(0.1); }), HasSubstr("m from an opening"));
  EXPECT_GT(membranes.counters().refused, 5);
  EXPECT_LT(membranes.counters().refused, 60);
  EXPECT_NEAR(look_at(membranes).shape.upper.x(), 23 * micron, 1e-3 * micron);
}

TEST(ImplicitMembranes, count_the_steps_that_they_refuse) {
  // The first step trusts the flow, which is slow; the cell itself is fast.
  CellPlan plan = soft;
  plan.bending_modulus = 2e-17;
  std::vector<Vector<2>> ellipse = circle(3 * micron, 40);
  for (Vector<2>& x : ellipse) x = {1.6 * x.x(), 0.5 * x.y()};
  ImplicitMembranes membranes(shear(1), {cell_of(ellipse, plan)},
                              {.longest_step = 1e-2, .step_tolerance = 1e-3});
  membranes.advance_by(0.1);
  EXPECT_GT(membranes.counters().refused, 0);
}

// Coordinates lose digits far from the origin; what they have left is good enough.
TEST(ImplicitMembranes, go_on_far_from_the_origin) {
  CellPlan plan = soft;
  plan.centre = {10, 0};
  ImplicitMembranes far(shear(rate), {deflated_cell(plan)}, {.longest_step = 1e-3});
  plan.centre = {0, 0};
  ImplicitMembranes near(shear(rate), {deflated_cell(plan)}, {.longest_step = 1e-3});
  far.advance_by(1 / rate);
  near.advance_by(1 / rate);
  EXPECT_NEAR(look_at(far).shape.inclination, look_at(near).shape.inclination, 1e-4);
  EXPECT_EQ(far.counters().refused, 0);
}

// Relaxation in plasma at rest: nothing but the cell itself sets the scale of velocities.
TEST(ImplicitMembranes, relax_in_plasma_at_rest) {
  std::vector<Vector<2>> ellipse = circle(3 * micron, 40);
  for (Vector<2>& x : ellipse) x = {1.3 * x.x(), 0.6 * x.y()};
  CellPlan plan{.nodes = 40, .bending_modulus = 2e-18, .centre = {12 * micron, 5 * micron}};
  const auto still =
      around(channel_nodes(24 * micron, 10 * micron, false, {.spacing = 1 * micron}));
  ImplicitMembranes membranes(still, {cell_of(ellipse, plan)}, {.longest_step = 0.002});
  const Cell& cell = membranes.cells()[0];
  double before = cell.membrane->energy(cell.positions).total();
  for (int k = 0; k < 10; ++k) {
    membranes.advance_by(0.03);
    const double energy = cell.membrane->energy(cell.positions).total();
    EXPECT_LT(energy, before * (1 + 1e-9));
    before = energy;
  }
  EXPECT_LT(look_at(membranes).motion.largest_relative, 1e-6 * micron / 0.03);
}

}  // namespace
}  // namespace hemoscale::micro
