#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include "micro/error.hpp"
#include "micro/mps/plasma_model.hpp"
#include "tests/support/mps/flows.hpp"

namespace hemoscale::micro {
namespace {

using namespace test;

constexpr Fluid fluid{.density = 1, .kinematic_viscosity = 1};

StageOptions moving(NodeMotion motion) {
  StageOptions options;
  options.motion = motion;
  options.shifting = Shifting::concentration;
  options.shifting_strength = 0.3;
  return options;
}

void expect_same(const ParticleSet<2>& a, const ParticleSet<2>& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.velocities, b.velocities);
  EXPECT_EQ(a.pressures, b.pressures);
  EXPECT_EQ(a.identities, b.identities);
  EXPECT_EQ(a.kinds, b.kinds);
}

void expect_identical_continuation(const FlowDomain<2>& domain, const StageOptions& options,
                                   double step) {
  PlasmaModel<2> whole(domain, fluid, options, step);
  whole.advance_by(10 * step);
  const Snapshot state = whole.snapshot();
  whole.advance_by(10 * step);

  PlasmaModel<2> continued(domain, fluid, options, step);
  continued.restore(state);
  EXPECT_EQ(continued.observe().steps, 10);
  continued.advance_by(10 * step);
  expect_same(whole.particles(), continued.particles());
  EXPECT_EQ(whole.time(), continued.time());
  EXPECT_EQ(whole.observe().entered, continued.observe().entered);
  EXPECT_EQ(whole.observe().left, continued.observe().left);
}

TEST(StageRestart, continues_with_identical_bits) {
  expect_identical_continuation(open_channel(8, 0.1), {}, 0.02);
  expect_identical_continuation(open_channel(8, 0.1), moving(NodeMotion::lagrangian), 0.02);
  expect_identical_continuation(open_channel(8, 0.1), moving(NodeMotion::ale), 0.02);
  StageOptions incremental = moving(NodeMotion::lagrangian);
  incremental.coupling = PressureCoupling::incremental;
  incremental.linear_solver = LinearSolverKind::aggregate;
  expect_identical_continuation(forced_channel(8, 0.1, 2, 0.1), incremental, 0.02);
  FlowDomain<2> sheared = periodic_nodes<2>({1, 1}, {.spacing = 0.1, .disorder = 0.1, .seed = 2});
  sheared.sliding_rate = 1;
  expect_identical_continuation(sheared, moving(NodeMotion::lagrangian), 0.05);
}

TEST(StageRestart, refuses_the_state_of_another_model) {
  PlasmaModel<2> model(open_channel(8), fluid, StageOptions{}, 0.02);
  Snapshot state = model.snapshot();
  EXPECT_NO_THROW(model.restore(state));
  Snapshot cut = state;
  cut.reals["stage.pressures"].pop_back();
  EXPECT_THROW(model.restore(cut), ParameterError);
  cut = state;
  cut.integers.erase("stage.kinds");
  EXPECT_THROW(model.restore(cut), ParameterError);
  cut = state;
  cut.integers["stage.counters"][0] = 3;
  EXPECT_THROW(model.restore(cut), ParameterError);
}

TEST(StageThreads, give_the_same_bits) {
  const int threads = omp_get_max_threads();
  std::vector<ParticleSet<2>> found;
  for (const int count : {1, 2, 3}) {
    omp_set_num_threads(count);
    for (const bool is_coupled : {true, false}) {
      StageOptions options = moving(NodeMotion::lagrangian);
      options.coupling = is_coupled ? PressureCoupling::coupled : PressureCoupling::incremental;
      StageStepper<2> stepper(open_channel(12, 0.1, 4), fluid, options);
      for (int k = 0; k < 4; ++k) stepper.step(0.01);
      found.push_back(stepper.particles());
    }
  }
  omp_set_num_threads(threads);
  for (std::size_t k = 2; k < found.size(); ++k) expect_same(found[k % 2], found[k]);
}

}  // namespace
}  // namespace hemoscale::micro
