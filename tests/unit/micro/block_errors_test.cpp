#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "micro/error.hpp"
#include "tests/support/micro/block_runs.hpp"

namespace hemoscale::micro {
namespace {

using test::BlockCase;
using testing::AllOf;
using testing::HasSubstr;

std::string refusal(const BlockCase& c) {
  try {
    c.make(Precision::single);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "accepted";
}

struct Fault {
  const char* name;
  std::function<void(BlockCase&)> plant;
  std::vector<const char*> parts;  // of the message
};

void PrintTo(const Fault& f, std::ostream* out) {
  *out << f.name;
}

class BlockFaults : public testing::TestWithParam<Fault> {};

TEST_P(BlockFaults, are_named_with_value_range_and_remedy) {
  BlockCase c = test::crowded_channel();
  ASSERT_EQ(refusal(c), "accepted");
  GetParam().plant(c);
  const std::string text = refusal(c);
  for (const char* part : GetParam().parts) EXPECT_THAT(text, HasSubstr(part));
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    All, BlockFaults,
    testing::Values(
        Fault{"no_state", [](BlockCase& c) { c.initial.clear(); }, {"0 initial states", "both"}},
        Fault{"state_missing",
              [](BlockCase& c) { c.initial.pop_back(); },
              {"2 kinds", "1 initial states"}},
        Fault{"other_nodes",
              [](BlockCase& c) { c.initial.front().nodes = 99; },
              {"kind 0 has 100 nodes", "must agree"}},
        Fault{"coordinate_missing",
              [](BlockCase& c) { c.initial.back().y.pop_back(); },
              {"kind 1", "must agree"}},
        Fault{"no_drag",
              [](BlockCase& c) { c.settings.kinds.back().node_drag = 0; },
              {"kind 1 has a node drag of 0", "positive"}},
        Fault{"drag_not_a_number",
              [](BlockCase& c) { c.settings.kinds.back().node_drag = none; },
              {"node drag of nan", "positive"}},
        Fault{"few_nodes",
              [](BlockCase& c) {
                c.settings.kinds.back().mesh =
                    make_ring_mesh({{1e-6, 0}, {0, 1e-6}, {-1e-6, 0}}, NaturalShape::outline);
              },
              {"3 nodes", "8 to 4000"}},
        Fault{"no_step", [](BlockCase& c) { c.settings.time_step = 0; }, {"time step 0 s"}},
        Fault{"step_back", [](BlockCase& c) { c.settings.time_step = -1e-3; }, {"positive"}},
        Fault{"endless_step",
              [](BlockCase& c) { c.settings.time_step = std::numeric_limits<double>::infinity(); },
              {"time step inf s", "finite"}},
        Fault{"no_threads", [](BlockCase& c) { c.settings.threads = 0; }, {"0 threads"}},
        Fault{"no_skin", [](BlockCase& c) { c.settings.skin = 0; }, {"skin 0 m", "positive"}},
        Fault{"no_flow", [](BlockCase& c) { c.settings.flow = nullptr; }, {"no flow"}},
        Fault{"two_laws_of_bending",
              [](BlockCase& c) { c.settings.kinds.back().laws.bending = HalfAngleBending{2e-19}; },
              {"law of bending", "kind 1"}}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(BlockFaultsTogether, are_named_all_at_once) {
  BlockCase c = test::crowded_channel();
  c.settings.threads = -2;
  c.settings.time_step = none;
  c.settings.skin = -1e-6;
  EXPECT_THAT(refusal(c),
              AllOf(HasSubstr("-2 threads"), HasSubstr("time step nan"), HasSubstr("skin -1e-06")));
}

TEST(BlockFailure, of_a_segment_is_told_with_step_cell_value_and_remedy) {
  BlockCase c = test::crowded_channel();
  BlockEnsemble ensemble = c.make(Precision::single);
  ensemble.segment_strain_limit = 1e-4;
  try {
    ensemble.advance(200);
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("step "), HasSubstr("time 0."), HasSubstr("a segment of cell "),
                      HasSubstr("at most 1 is admitted"), HasSubstr("reduce the time step")));
  }
  EXPECT_GT(ensemble.largest_segment_strain(), 1e-4);
}

// An unstable run ends with the cell that broke, for every kind of number that is not finite.
TEST(BlockFailure, of_numbers_is_told_with_the_cell_and_the_remedy) {
  for (const Precision precision : {Precision::single, Precision::twofold}) {
    for (const int threads : {1, 3}) {
      BlockCase c = test::crowded_channel();
      c.settings.integrator = test::Integrator::explicit_euler;
      c.settings.time_step = 1e-4;
      c.settings.force = true;
      c.settings.threads = threads;
      BlockEnsemble ensemble = c.make(precision);
      ensemble.segment_strain_limit = std::numeric_limits<double>::infinity();
      try {
        ensemble.advance(5000);
        FAIL();
      } catch (const NumericalError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("step "), HasSubstr("of cell "),
                                        HasSubstr("is not finite"), HasSubstr("reduce it")));
      }
    }
  }
}

/// Fails at a time.
class FailingFlow final : public GivenFlow {
 public:
  LocalFlow at(const Vector<2>& x, double time) const override {
    if (time > 0.0105 && x.x() > 10e-6) throw EnvironmentError("the flow has ended");
    LocalFlow flow;
    flow.velocity[0] = 6 * x.y();
    flow.gradient(0, 1) = 6;
    return flow;
  }
  bool is_steady() const override { return false; }
  double largest_shear_rate() const override { return 6; }
  double largest_speed() const override { return 1e-4; }
};

// The exception of a flow comes through, and no thread waits for ever for the one that failed.
TEST(BlockFailure, of_the_flow_comes_through_from_any_thread) {
  for (const int threads : {1, 2, 5}) {
    BlockCase c = test::shear_box(6, {.columns = 6, .rows = 6});
    c.settings.flow = std::make_shared<FailingFlow>();
    c.settings.threads = threads;
    BlockEnsemble ensemble = c.make(Precision::twofold);
    EXPECT_THROW(ensemble.advance(100), EnvironmentError) << threads;
  }
}

}  // namespace
}  // namespace hemoscale::micro
