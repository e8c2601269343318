#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "micro/error.hpp"
#include "tests/support/micro/block_runs.hpp"

namespace hemoscale::micro {
namespace {

using test::BlockCase;
using test::Integrator;
using testing::HasSubstr;

struct RestartCase {
  const char* name;
  Precision precision;
  Integrator integrator;
};

void PrintTo(const RestartCase& c, std::ostream* out) {
  *out << c.name;
}

class BlockRestart : public testing::TestWithParam<RestartCase> {};

// Saves between centrings of frames and rebuilds of lists, into ensembles of other threads and
// other initial states.
TEST_P(BlockRestart, continues_with_the_same_bits) {
  BlockCase c = test::crowded_channel();
  test::set_integrator(c.settings, GetParam().integrator);
  BlockEnsemble whole = c.make(GetParam().precision);
  whole.advance(500);
  BlockEnsemble first = c.make(GetParam().precision);
  Snapshot saved = first.snapshot();
  BlockCase other = test::crowded_channel({.seed = 2});
  test::set_integrator(other.settings, GetParam().integrator);
  for (const std::int64_t steps : {1, 7, 100, 156, 236}) {
    other.settings.threads = static_cast<int>(1 + steps % 3);
    BlockEnsemble next = other.make(GetParam().precision);
    next.advance(3);
    next.restore(saved);
    next.advance(steps);
    saved = next.snapshot();
  }
  const Snapshot wanted = whole.snapshot();
  EXPECT_EQ(saved.reals, wanted.reals);
  EXPECT_EQ(saved.integers, wanted.integers);
}

INSTANTIATE_TEST_SUITE_P(
    Integrators, BlockRestart,
    testing::Values(
        RestartCase{"explicit_single", Precision::single, Integrator::explicit_euler},
        RestartCase{"explicit_double", Precision::twofold, Integrator::explicit_euler},
        RestartCase{"implicit_single", Precision::single, Integrator::linearly_implicit},
        RestartCase{"implicit_double", Precision::twofold, Integrator::linearly_implicit},
        RestartCase{"constant_operator", Precision::single, Integrator::constant_operator},
        RestartCase{"constant_operator_second_order", Precision::twofold,
                    Integrator::constant_operator_second_order},
        RestartCase{"inertial", Precision::twofold, Integrator::inertial},
        RestartCase{"chebyshev", Precision::twofold, Integrator::chebyshev}),
    [](const auto& each) { return std::string(each.param.name); });

class BlockSnapshot : public testing::Test {
 protected:
  void expect_refused(const Snapshot& snapshot, const char* part) {
    const Snapshot before = ensemble.snapshot();
    try {
      ensemble.restore(snapshot);
      FAIL() << "accepted: " << part;
    } catch (const ParameterError& error) {
      EXPECT_THAT(error.what(), HasSubstr(part));
      EXPECT_THAT(error.what(), HasSubstr("restore it into"));
    }
    // What was refused has changed nothing.
    EXPECT_EQ(ensemble.snapshot().reals, before.reals);
    EXPECT_EQ(ensemble.snapshot().integers, before.integers);
  }
  BlockCase setting = test::crowded_channel();
  BlockEnsemble ensemble = setting.make(Precision::single);
};

TEST_F(BlockSnapshot, of_another_ensemble_is_refused) {
  expect_refused({}, "snapshot: ");
  const Snapshot mine = ensemble.snapshot();
  for (const auto& [name, values] : mine.reals) {
    if (values.empty()) continue;
    Snapshot shorter = mine;
    shorter.reals[name].pop_back();
    expect_refused(shorter, name.c_str());
    Snapshot broken = mine;
    broken.reals[name].back() = std::numeric_limits<double>::quiet_NaN();
    expect_refused(broken, name.c_str());
  }
  for (const auto& [name, values] : mine.integers) {
    Snapshot missing = mine;
    missing.integers.erase(name);
    expect_refused(missing, "snapshot: ");
    Snapshot negative = mine;
    negative.integers[name].back() = -1;
    expect_refused(negative, "snapshot: ");
    Snapshot longer = mine;
    longer.integers[name].push_back(7);
    expect_refused(longer, "snapshot: ");
  }
}

}  // namespace
}  // namespace hemoscale::micro
