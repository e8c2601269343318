#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "coupling/error.hpp"
#include "coupling/sampling/sample_points.hpp"
#include "coupling/scheme/coupling_scheme.hpp"
#include "macro/analytic/channel_model.hpp"
#include "tests/support/coupling_doubles.hpp"

namespace hemoscale::coupling {
namespace {

constexpr double hematocrit = 0.4;
constexpr double height = 1e-4;  // [m]

struct Setting {
  std::string name;
  Relaxation relaxation;
  Memory memory;
};

class LoopRestart : public ::testing::TestWithParam<Setting> {
 protected:
  CoupledLoop make_loop() const {
    LoopOptions options = testing::loop_options(testing::short_run());
    options.relaxation = GetParam().relaxation;
    options.memory = GetParam().memory;
    options.tolerance = 1e-12;
    options.stop_at_noise = false;
    return CoupledLoop(testing::newtonian(3.5e-3), options,
                       testing::synthetic(testing::blood(), 0.05, 7), alone_);
  }

  macro::ChannelModel<2> model_ = [] {
    macro::Channel parameters;
    parameters.height = height;
    parameters.hematocrit = hematocrit;
    parameters.drive = macro::PressureGradient{2 / height};
    return macro::ChannelModel<2>(parameters);
  }();
  CoupledFlow<2> flow_{model_, points_across<2>({0, height / 2}, {0, 0}, 5, 0.1), hematocrit};
  micro::Communicator alone_;
};

void expect_same(const micro::Snapshot& a, const micro::Snapshot& b) {
  EXPECT_EQ(a.reals, b.reals);
  EXPECT_EQ(a.integers, b.integers);
}

TEST_P(LoopRestart, continues_with_the_same_bits_after_any_pass) {
  constexpr int total = 5;
  Explicit<2> scheme;
  CoupledLoop whole = make_loop();
  std::vector<LoopReport> reports;
  for (int pass = 0; pass < total; ++pass) {
    reports.push_back(scheme.advance(flow_, whole, {}, {}).passes.at(0));
  }
  for (int before = 0; before < total; ++before) {
    CoupledLoop first = make_loop();
    for (int pass = 0; pass < before; ++pass) scheme.advance(flow_, first, {}, {});
    CoupledLoop second = make_loop();
    second.restore(first.snapshot());
    expect_same(second.snapshot(), first.snapshot());
    for (int pass = before; pass < total; ++pass) {
      const LoopReport report = scheme.advance(flow_, second, {}, {}).passes.at(0);
      EXPECT_EQ(report.pass, pass + 1);
      EXPECT_EQ(report.change, reports[static_cast<std::size_t>(pass)].change);
      EXPECT_EQ(report.relaxation_factor,
                reports[static_cast<std::size_t>(pass)].relaxation_factor);
    }
    expect_same(second.snapshot(), whole.snapshot());
  }
}

TEST_P(LoopRestart, an_implicit_window_continues_in_its_middle) {
  constexpr int passes = 6;
  CoupledLoop whole = make_loop();
  std::vector<micro::Snapshot> states;
  const WindowReport<2> window = Implicit<2>(passes).advance(
      flow_, whole, {}, [&](const LoopReport&) { states.push_back(whole.snapshot()); });
  for (const micro::Snapshot& state : states) {
    CoupledLoop continued = make_loop();
    continued.restore(state);
    const WindowReport<2> rest = Implicit<2>(passes).advance(flow_, continued, {}, {});
    EXPECT_EQ(rest.converged, window.converged);
    expect_same(continued.snapshot(), whole.snapshot());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Settings, LoopRestart,
    ::testing::Values(Setting{"constant_accumulate", ConstantRelaxation{0.7}, Memory::accumulate},
                      Setting{"none_accumulate", ConstantRelaxation{1}, Memory::accumulate},
                      Setting{"aitken_accumulate", AitkenRelaxation{0.5}, Memory::accumulate},
                      Setting{"aitken_latest", AitkenRelaxation{0.5, 0.1, 2}, Memory::latest}),
    [](const auto& setting) { return setting.param.name; });

class BrokenSnapshot : public ::testing::Test {
 protected:
  void expect_refused(const std::string& what) {
    const micro::Snapshot before = loop_.snapshot();
    try {
      loop_.restore(state_);
      FAIL();
    } catch (const EnvironmentError& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(what));
    }
    expect_same(loop_.snapshot(), before);
  }

  micro::Communicator alone_;
  CoupledLoop loop_{testing::newtonian(1), testing::loop_options(testing::short_run()),
                    testing::synthetic(testing::blood(), 0.05, 7), alone_};
  micro::Snapshot state_ = [&] {
    loop_.pass({simple_shear(10, 0.4), simple_shear(50, 0.4)});
    loop_.pass({simple_shear(20, 0.4), simple_shear(60, 0.4)});
    return loop_.snapshot();
  }();
};

TEST_F(BrokenSnapshot, of_another_kind_of_run) {
  state_ = micro::Snapshot{};
  expect_refused("loop.counters");
}

TEST_F(BrokenSnapshot, of_another_format) {
  state_.integers["loop.counters"][0] = 99;
  expect_refused("format 99");
}

TEST_F(BrokenSnapshot, without_the_law) {
  state_.reals.erase("loop.law.shear_rates");
  expect_refused("loop.law.shear_rates");
}

TEST_F(BrokenSnapshot, with_knots_that_do_not_fit) {
  state_.integers["loop.law.knots"][0] += 1;
  expect_refused("do not fit");
}

TEST_F(BrokenSnapshot, with_a_short_array_of_samples) {
  state_.reals["loop.samples.viscosity"].pop_back();
  expect_refused("loop.samples.viscosity");
}

TEST_F(BrokenSnapshot, with_a_model_of_no_slot) {
  state_.reals["model.first.noise"] = {1};
  expect_refused("model.first.noise");
}

}  // namespace
}  // namespace hemoscale::coupling
