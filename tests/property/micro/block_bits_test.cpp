#include <gtest/gtest.h>

#include "tests/support/micro/block_runs.hpp"

// What must not change a bit of a run: threads, lists, the order of cells in blocks, the division
// into calls.
namespace hemoscale::micro {
namespace {

using test::BlockCase;
using test::Integrator;

struct BitsCase {
  const char* name;
  BlockCase (*make)();
  Precision precision;
  Integrator integrator;
};

void PrintTo(const BitsCase& c, std::ostream* out) {
  *out << c.name;
}

BlockCase channel() {
  return test::crowded_channel();
}
BlockCase sheared() {
  return test::shear_box(6);
}

/// Changes in time.
class SwingingFlow final : public GivenFlow {
 public:
  LocalFlow at(const Vector<2>& x, double time) const override {
    LocalFlow flow;
    const double rate = 6 * std::cos(40 * time);
    flow.velocity[0] = rate * x.y();
    flow.gradient(0, 1) = rate;
    return flow;
  }
  bool is_steady() const override { return false; }
  double largest_shear_rate() const override { return 6; }
  double largest_speed() const override { return 1e-4; }
};
BlockCase swinging() {
  BlockCase c = test::crowded_channel();
  c.settings.flow = std::make_shared<SwingingFlow>();
  c.initial.front().time = 0.3;
  return c;
}

class BlockBits : public testing::TestWithParam<BitsCase> {
 protected:
  // Contacts begin before the half of it with the steps of the implicit integrators.
  static constexpr std::int64_t steps = 600;

  static BlockCase fresh() {
    BlockCase c = GetParam().make();
    test::set_integrator(c.settings, GetParam().integrator);
    return c;
  }
  static BlockEnsemble run(const BlockCase& c) {
    BlockEnsemble ensemble = c.make(GetParam().precision);
    ensemble.advance(steps);
    return ensemble;
  }
  static void expect_same_bits(const Snapshot& a, const Snapshot& b) {
    EXPECT_EQ(a.reals, b.reals);
    EXPECT_EQ(a.integers, b.integers);
  }
};

TEST_P(BlockBits, do_not_depend_on_the_number_of_threads) {
  BlockCase c = fresh();
  const BlockEnsemble one = run(c);
  for (const int threads : {2, 3, 5}) {
    c.settings.threads = threads;
    expect_same_bits(run(c).snapshot(), one.snapshot());
  }
}

// Blocks that are taken several steps ahead, tile after tile.
TEST_P(BlockBits, do_not_depend_on_the_tiles) {
  BlockCase c = test::crowded_channel({.columns = 400});
  c.settings.kinds.pop_back();
  c.initial.pop_back();
  if (GetParam().make == swinging) {
    c.settings.flow = std::make_shared<SwingingFlow>();
    c.initial.front().time = 0.3;
  }
  test::set_integrator(c.settings, GetParam().integrator);
  const auto run_with = [&](std::size_t cache, int threads, bool is_tiled) {
    c.settings.cache = cache;
    c.settings.threads = threads;
    BlockEnsemble ensemble = c.make(GetParam().precision);
    ensemble.advance(40);
    EXPECT_EQ(ensemble.counters().tiled_legs > 0, is_tiled);
    return ensemble.snapshot();
  };
  const Snapshot usual = run_with(1U << 30U, 1, false);
  const std::size_t cache = GetParam().precision == Precision::single ? 3000000 : 6000000;
  for (const int threads : {1, 2, 3}) expect_same_bits(run_with(cache, threads, true), usual);
}

TEST_P(BlockBits, do_not_depend_on_the_skin_of_the_list) {
  BlockCase c = fresh();
  const BlockEnsemble usual = run(c);
  if (test::is_implicit(GetParam().integrator) && usual.settings().flow->is_steady()) {
    EXPECT_GT(test::count_contacts(usual.states(), 0.5e-6), 50U);
    EXPECT_GT(usual.counters().rebuilds, 2);
  }
  for (const double skin : {0.05e-6, 0.4e-6}) {
    c.settings.skin = skin;
    const BlockEnsemble other = run(c);
    expect_same_bits(other.snapshot(), usual.snapshot());
    // With so small a skin that it lasts for a step or two, the reach of the next can be misjudged.
    // So it can where the flow turns.
    if (skin > 0.1e-6 && usual.settings().flow->is_steady()) {
      EXPECT_EQ(other.counters().late_rebuilds, 0);
    }
  }
}

TEST_P(BlockBits, do_not_depend_on_the_division_into_calls) {
  const BlockCase c = fresh();
  BlockEnsemble divided = c.make(GetParam().precision);
  for (const std::int64_t part : {1, 7, 64, 100, 28, 13, 387}) divided.advance(part);
  EXPECT_EQ(divided.step(), steps);
  expect_same_bits(divided.snapshot(), run(c).snapshot());
}

// An ensemble that is restored after every step builds a list for every step, with all cells in
// blocks anew.
TEST_P(BlockBits, do_not_depend_on_the_age_of_the_list_nor_on_restarts) {
  const BlockCase c = fresh();
  BlockEnsemble renewed = c.make(GetParam().precision);
  for (std::int64_t k = 0; k < steps; ++k) {
    renewed.advance(1);
    renewed.restore(renewed.snapshot());
  }
  EXPECT_GE(renewed.counters().rebuilds, steps);
  expect_same_bits(renewed.snapshot(), run(c).snapshot());
}

// Given in another order, cells have other numbers: sums over several partners run in another
// order, which changes round-off and nothing else.
TEST_P(BlockBits, the_order_of_cells_changes_round_off_alone) {
  BlockCase c = fresh();
  const auto usual = run(c).states();
  EnsembleState& first = c.initial.front();
  const std::size_t n = first.nodes;
  const std::size_t cells = first.cells;
  const EnsembleState before = first;
  const auto partner = [&](std::size_t cell) { return (5 * cell + 3) % cells; };
  for (std::size_t cell = 0; cell < cells; ++cell) {
    for (std::size_t i = 0; i < n; ++i) {
      first.x[partner(cell) * n + i] = before.x[cell * n + i];
      first.y[partner(cell) * n + i] = before.y[cell * n + i];
    }
  }
  auto permuted = run(c).states();
  const EnsembleState other = permuted.front();
  for (std::size_t cell = 0; cell < cells; ++cell) {
    for (std::size_t i = 0; i < n; ++i) {
      permuted.front().x[cell * n + i] = other.x[partner(cell) * n + i];
      permuted.front().y[cell * n + i] = other.y[partner(cell) * n + i];
    }
  }
  const double difference = test::node_difference(usual, permuted);
  EXPECT_LE(difference, GetParam().precision == Precision::single ? 2e-10 : 1e-18);
}

INSTANTIATE_TEST_SUITE_P(
    Runs, BlockBits,
    testing::Values(
        BitsCase{"channel_single", channel, Precision::single, Integrator::linearly_implicit},
        BitsCase{"channel_double", channel, Precision::twofold, Integrator::linearly_implicit},
        BitsCase{"sheared_single", sheared, Precision::single, Integrator::linearly_implicit},
        BitsCase{"sheared_double", sheared, Precision::twofold, Integrator::linearly_implicit},
        BitsCase{"channel_explicit_single", channel, Precision::single, Integrator::explicit_euler},
        BitsCase{"sheared_explicit_double", sheared, Precision::twofold,
                 Integrator::explicit_euler},
        BitsCase{"swinging_double", swinging, Precision::twofold, Integrator::linearly_implicit},
        BitsCase{"swinging_constant_operator", swinging, Precision::single,
                 Integrator::constant_operator},
        BitsCase{"sheared_inertial", sheared, Precision::twofold, Integrator::inertial},
        BitsCase{"channel_chebyshev", channel, Precision::single, Integrator::chebyshev},
        BitsCase{"channel_constant_operator", channel, Precision::single,
                 Integrator::constant_operator},
        BitsCase{"sheared_constant_operator_second_order", sheared, Precision::single,
                 Integrator::constant_operator_second_order}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace hemoscale::micro
