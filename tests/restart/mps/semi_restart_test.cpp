#include <gtest/gtest.h>
#include <omp.h>

#include <functional>

#include "micro/error.hpp"
#include "micro/mps/lattice_domains_flows.hpp"
#include "micro/mps/semi_implicit_stepper.hpp"

namespace hemoscale::micro {
namespace {

struct Scene {
  const char* name;
  std::function<SemiImplicitStepper<2>()> make;
  double dt;
};

void PrintTo(const Scene& scene, std::ostream* out) {
  *out << scene.name;
}

SemiImplicitStepper<2> open_channel() {
  SemiImplicitOptions options = best_repaired();
  options.speed = 0.01;
  return SemiImplicitStepper<2>(
      lattice_open_channel({.spacing = 1e-6}, 30e-6, 10e-6, parabolic_inflow(0.01, 10e-6)),
      {.density = 1000, .kinematic_viscosity = 1e-6}, options);
}

SemiImplicitStepper<2> literal_channel() {
  SemiImplicitOptions options = paper_literal();
  options.relaxation = 0.2;
  options.speed = 0.01;
  return SemiImplicitStepper<2>(lattice_periodic_channel({.spacing = 1e-6}, 20e-6, 10e-6, 1200),
                                {.density = 1000, .kinematic_viscosity = 1e-6}, options);
}

// Fast enough to search and to order anew every few steps.
SemiImplicitStepper<2> vortices() {
  SemiImplicitOptions options = best_repaired();
  options.coupling = ParticleCoupling::incremental;
  options.source = IncompressibilitySource::hs_ecs;
  options.speed = 1;
  return SemiImplicitStepper<2>(lattice_taylor_green<2>({.spacing = 0.05, .disorder = 0.1}, 1, 1),
                                {.density = 1, .kinematic_viscosity = 0.01}, options);
}

SemiImplicitStepper<2> tank() {
  SemiImplicitOptions options = paper_literal();
  options.gradient_form = GradientForm::minimum;
  options.relaxation = 0.1;
  options.free_surface_ratio = 0.97;
  options.speed = 1.4;
  return SemiImplicitStepper<2>(lattice_tank({.spacing = 0.02}, 0.2, 0.2, 9.81),
                                {.density = 1000, .kinematic_viscosity = 1e-2}, options);
}

class SemiImplicitRestart : public testing::TestWithParam<Scene> {};
INSTANTIATE_TEST_SUITE_P(, SemiImplicitRestart,
                         testing::Values(Scene{"open_channel", open_channel, 5e-6},
                                         Scene{"literal_channel", literal_channel, 2e-7},
                                         Scene{"vortices", vortices, 4e-3},
                                         Scene{"tank", tank, 7e-4}),
                         [](const auto& each) { return std::string(each.param.name); });

void expect_same(const Snapshot& a, const Snapshot& b) {
  EXPECT_EQ(a.integers, b.integers);
  for (const auto& [name, values] : a.reals) EXPECT_EQ(values, b.reals.at(name)) << name;
}

TEST_P(SemiImplicitRestart, continues_with_the_same_bits) {
  const Scene& scene = GetParam();
  SemiImplicitStepper<2> whole = scene.make();
  for (int n = 0; n < 23; ++n) whole.step(scene.dt);
  const Snapshot saved = whole.snapshot();
  SemiImplicitStepper<2> second = scene.make();
  second.restore(saved);
  EXPECT_EQ(second.time(), whole.time());
  for (int n = 0; n < 30; ++n) {
    whole.step(scene.dt);
    second.step(scene.dt);
  }
  expect_same(whole.snapshot(), second.snapshot());
}

TEST_P(SemiImplicitRestart, does_not_depend_on_the_number_of_threads) {
  const Scene& scene = GetParam();
  const int threads = omp_get_max_threads();
  std::vector<Snapshot> ends;
  for (const int count : {1, 2, 3}) {
    omp_set_num_threads(count);
    SemiImplicitStepper<2> stepper = scene.make();
    for (int n = 0; n < 25; ++n) stepper.step(scene.dt);
    ends.push_back(stepper.snapshot());
  }
  omp_set_num_threads(threads);
  expect_same(ends[0], ends[1]);
  expect_same(ends[0], ends[2]);
}

TEST(SemiImplicitSnapshot, of_another_dimension_or_incomplete_is_refused) {
  SemiImplicitStepper<2> stepper = tank();
  Snapshot snapshot = stepper.snapshot();
  SemiImplicitStepper<3> other(lattice_taylor_green<3>({.spacing = 0.1}, 1, 1),
                               {.density = 1, .kinematic_viscosity = 1}, [] {
                                 SemiImplicitOptions options = best_repaired();
                                 options.speed = 1;
                                 return options;
                               }());
  EXPECT_THROW(other.restore(snapshot), ParameterError);
  snapshot.reals["semi_implicit.pressures"].pop_back();
  EXPECT_THROW(stepper.restore(snapshot), ParameterError);
  snapshot.reals.erase("semi_implicit.pressures");
  EXPECT_THROW(stepper.restore(snapshot), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
