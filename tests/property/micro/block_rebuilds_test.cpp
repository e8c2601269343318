#include <gtest/gtest.h>

#include "micro/ensemble/blocks/block_stepper.hpp"
#include "tests/support/micro/block_pairs.hpp"
#include "tests/support/micro/block_runs.hpp"

// The bound that decides when lists are rebuilt: at no step may two nodes be in contact that the
// list of that step does not hold.
namespace hemoscale::micro {
namespace {

using test::BlockCase;
using test::Integrator;

template <class Real>
void expect_complete_at_every_step(const BlockCase& c, std::int64_t steps) {
  std::vector<blocks::CellKind> kinds;
  std::vector<blocks::CellRecord> cells;
  for (const EnsembleState& state : c.initial) {
    const auto more = blocks::to_records<Real>(state, static_cast<std::int32_t>(kinds.size()),
                                               static_cast<blocks::CellId>(cells.size()));
    cells.insert(cells.end(), more.begin(), more.end());
    kinds.push_back({static_cast<int>(state.nodes), state.cells});
  }
  auto store = blocks::make_store<Real>(kinds, cells, cells.size(),
                                        blocks::has_memory(c.settings.integrator), 0);
  blocks::BlockStepper<Real> stepper(c.settings);
  double offset = 0;
  std::size_t most = 0;
  std::size_t missing = 0;
  for (std::int64_t step = 0; step < steps && missing == 0; ++step) {
    const test::Periodicity p{c.settings.length / test::um,
                              c.settings.periodic_y ? c.settings.height / test::um : 0,
                              offset / test::um};
    stepper.advance(store, step, 1, static_cast<double>(step) * c.settings.time_step, offset);
    // The buffer of the step before still holds what the step has seen.
    std::size_t pairs = 0;
    missing = test::missing_pairs(store, static_cast<std::size_t>(step % 2), p, 0.5,
                                  stepper.contacts(), &pairs);
    EXPECT_EQ(missing, 0) << "step " << step;
    most = std::max(most, pairs);
  }
  EXPECT_GT(most, 50U);
  EXPECT_EQ(stepper.counters().late_rebuilds, 0);
  EXPECT_LT(stepper.counters().rebuilds, steps / 2);
}

struct RebuildCase {
  const char* name;
  BlockCase (*make)();
  Integrator integrator;
  double skin;  // [m]
};

void PrintTo(const RebuildCase& c, std::ostream* out) {
  *out << c.name;
}

class BlockRebuilds : public testing::TestWithParam<RebuildCase> {};

TEST_P(BlockRebuilds, come_before_a_pair_is_missed) {
  BlockCase c = GetParam().make();
  test::set_integrator(c.settings, GetParam().integrator);
  c.settings.skin = GetParam().skin;
  expect_complete_at_every_step<float>(c, 250);
}

/// Hard cells that lie along the flow slide over each other: nodes hardly move against their
/// frames, but frames of neighbours part fast.
BlockCase sliding_cells() {
  BlockCase c = test::shear_box(6, {.columns = 2, .rows = 4});
  MembraneParameters hard;
  hard.stretch_modulus = 1e-4;
  hard.bending_modulus = 4e-17;
  c.settings.kinds.front().laws = make_membrane_laws(hard);
  return c;
}
BlockCase channel() {
  return test::crowded_channel();
}
BlockCase sheared() {
  return test::shear_box(6);
}

INSTANTIATE_TEST_SUITE_P(
    Runs, BlockRebuilds,
    testing::Values(
        RebuildCase{"channel", channel, Integrator::linearly_implicit, 0.15e-6},
        RebuildCase{"channel_long_lists", channel, Integrator::linearly_implicit, 0.6e-6},
        RebuildCase{"sheared", sheared, Integrator::linearly_implicit, 0.15e-6},
        RebuildCase{"sheared_long_lists", sheared, Integrator::linearly_implicit, 0.6e-6},
        RebuildCase{"sliding", sliding_cells, Integrator::linearly_implicit, 0.6e-6},
        RebuildCase{"predicted", channel, Integrator::constant_operator, 0.15e-6},
        RebuildCase{"predicted_sheared", sheared, Integrator::constant_operator_second_order,
                    0.3e-6}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace hemoscale::micro
