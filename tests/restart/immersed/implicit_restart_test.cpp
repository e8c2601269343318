#include <gtest/gtest.h>
#include <omp.h>

#include "micro/error.hpp"
#include "tests/support/immersed/implicit_runs.hpp"

namespace hemoscale::micro {
namespace {

using namespace test;

/// Two cells, one of them more viscous inside, between walls; or one alone in shear.
ImplicitMembranes in_channel(double step_tolerance) {
  CellPlan plan{.nodes = 40, .stretch_modulus = 1e-5, .bending_modulus = 2e-19};
  plan.centre = {7 * micron, 5.3 * micron};
  const Cell one = deflated_cell(plan);
  plan.centre = {19 * micron, 4.8 * micron};
  plan.viscosity_ratio = 5;
  plan.nodes = 33;
  return {kept_channel(24 * micron, 10 * micron, 1 * micron, 1e-3),
          {one, deflated_cell(plan)},
          {.longest_step = 3e-4, .step_tolerance = step_tolerance}};
}

ImplicitMembranes in_shear(double step_tolerance) {
  return {shear(100),
          {deflated_cell({.nodes = 40, .bending_modulus = 2e-19, .viscosity_ratio = 2})},
          {.longest_step = 1e-3, .step_tolerance = step_tolerance}};
}

void expect_same(const Snapshot& a, const Snapshot& b) {
  EXPECT_EQ(a.integers, b.integers);
  ASSERT_EQ(a.reals.size(), b.reals.size());
  for (const auto& [name, values] : a.reals) EXPECT_EQ(values, b.reals.at(name)) << name;
}

template <typename Make>
void continues(const Make& make) {
  for (const double tolerance : {0.0, 0.003}) {
    for (const int before : {0, 1, 4}) {
      ImplicitMembranes whole = make(tolerance);
      for (int k = 0; k < before; ++k) whole.advance_by(7e-4);
      const Snapshot saved = whole.snapshot();
      ImplicitMembranes second = make(tolerance);
      second.advance_by(1.3e-3);  // what it did before is forgotten
      second.restore(saved);
      expect_same(saved, second.snapshot());
      for (int k = 0; k < 3; ++k) {
        whole.advance_by(7e-4);
        second.advance_by(7e-4);
      }
      EXPECT_EQ(whole.time(), second.time());
      expect_same(whole.snapshot(), second.snapshot());
    }
  }
}

TEST(ImplicitRestart, continues_with_the_same_bits_between_walls) {
  continues(in_channel);
}

TEST(ImplicitRestart, continues_with_the_same_bits_in_shear) {
  continues(in_shear);
}

TEST(ImplicitRestart, continues_after_a_failure_with_the_same_bits) {
  CellPlan plan{.nodes = 40, .bending_modulus = 2e-19, .centre = {12 * micron, 5 * micron}};
  const auto make = [&] {
    return ImplicitMembranes(
        kept_channel(24 * micron, 10 * micron, 1 * micron, 1e-3), {deflated_cell(plan)},
        {.longest_step = 3e-4, .step_tolerance = 0, .sweep_tolerance = 1e-9, .most_sweeps = 4});
  };
  ImplicitMembranes membranes = make();
  Snapshot good = membranes.snapshot();
  bool has_failed = false;
  for (int k = 0; k < 40 && !has_failed; ++k) {
    try {
      membranes.advance_by(3e-4);
      good = membranes.snapshot();
    } catch (const NumericalError&) {
      has_failed = true;
    }
  }
  ASSERT_TRUE(has_failed);
  // All but the counters and the length of the next step is that of the last good step.
  Snapshot after = membranes.snapshot();
  after.integers = good.integers;
  after.reals["implicit.times"] = good.reals["implicit.times"];
  expect_same(good, after);
}

TEST(ImplicitRestart, does_not_depend_on_the_number_of_threads) {
  const int threads = omp_get_max_threads();
  std::vector<Snapshot> ends;
  for (const int count : {1, 2, 3}) {
    omp_set_num_threads(count);
    // So many nodes that products of matrices are worth sharing.
    CellPlan plan{.nodes = 200, .bending_modulus = 2e-18, .viscosity_ratio = 5};
    plan.centre = {12 * micron, 5.2 * micron};
    ImplicitMembranes membranes(kept_channel(24 * micron, 10 * micron, 0.5 * micron, 1e-3),
                                {deflated_cell(plan)}, {.longest_step = 3e-4});
    for (int k = 0; k < 3; ++k) membranes.advance_by(3e-4);
    ends.push_back(membranes.snapshot());
  }
  omp_set_num_threads(threads);
  expect_same(ends[0], ends[1]);
  expect_same(ends[0], ends[2]);
}

TEST(ImplicitSnapshot, of_other_runs_is_refused) {
  ImplicitMembranes membranes = in_channel(0);
  membranes.advance_by(1e-3);
  Snapshot snapshot = membranes.snapshot();
  snapshot.reals.erase("implicit.0.map");
  EXPECT_THROW(membranes.restore(snapshot), ParameterError);
  snapshot = membranes.snapshot();
  snapshot.reals["implicit.1.tensions"].pop_back();
  EXPECT_THROW(membranes.restore(snapshot), ParameterError);
  EXPECT_THROW(in_shear(0).restore(membranes.snapshot()), ParameterError);
  snapshot = membranes.snapshot();
  snapshot.integers.erase("implicit.counters");
  EXPECT_THROW(membranes.restore(snapshot), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
