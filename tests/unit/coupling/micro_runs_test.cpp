#include "coupling/scheme/micro_runs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "coupling/error.hpp"
#include "coupling/scheme/byte_stream.hpp"
#include "micro/error.hpp"
#include "tests/support/coupling_doubles.hpp"

namespace hemoscale::coupling {
namespace {

using ::testing::HasSubstr;

std::vector<PlannedRun> plan(int count) {
  std::vector<PlannedRun> result;
  for (int i = 0; i < count; ++i) result.push_back({i, simple_shear(10.0 * (i + 1), 0.4)});
  return result;
}

std::string bytes(const std::vector<FinishedRun>& runs, const MicroRuns& models) {
  ByteWriter writer;
  for (const FinishedRun& run : runs) {
    writer.integer(run.slot);
    writer.observation(run.observation);
  }
  for (const auto& [slot, state] : models.states()) writer.snapshot(state);
  return writer.bytes();
}

TEST(MicroRuns, one_and_several_threads_give_the_same_bits) {
  const micro::Communicator alone;
  const MicroFactory factory = testing::synthetic(testing::blood(), 0.05, 3);
  MicroRuns one(factory, alone, 1);
  MicroRuns two(factory, alone, 2);
  MicroRuns five(factory, alone, 5);
  for (int pass = 0; pass < 2; ++pass) {
    const auto first = one.advance(plan(7), testing::short_run(), {});
    const auto second = two.advance(plan(7), testing::short_run(), {});
    const auto third = five.advance(plan(7), testing::short_run(), {});
    EXPECT_EQ(bytes(first, one), bytes(second, two));
    EXPECT_EQ(bytes(first, one), bytes(third, five));
  }
}

TEST(MicroRuns, a_model_continues_from_its_last_state) {
  const micro::Communicator alone;
  MicroRuns runs(testing::synthetic(testing::blood(), 0.05, 3), alone, 1);
  const auto first = runs.advance(plan(1), testing::short_run(), {});
  const auto second = runs.advance(plan(1), testing::short_run(), {});
  EXPECT_NE(first[0].observation.shear_stress.mean, second[0].observation.shear_stress.mean);

  const auto model = testing::synthetic(testing::blood(), 0.05, 3)(0);
  model->advance(plan(1)[0].flow.forcing, testing::short_run());
  const auto direct = model->advance(plan(1)[0].flow.forcing, testing::short_run());
  EXPECT_EQ(second[0].observation.shear_stress.mean, direct.shear_stress.mean);
}

TEST(MicroRuns, a_model_is_made_once) {
  const micro::Communicator alone;
  std::vector<int> made;
  MicroRuns runs(
      [&, inside = testing::synthetic(testing::blood(), 0.05, 3)](int slot) {
        made.push_back(slot);
        return inside(slot);
      },
      alone, 1);
  for (int pass = 0; pass < 3; ++pass) runs.advance(plan(2), testing::short_run(), {});
  EXPECT_THAT(made, ::testing::UnorderedElementsAre(0, 1));
}

TEST(MicroRuns, restored_models_are_made_anew_with_the_same_bits) {
  const micro::Communicator alone;
  const MicroFactory factory = testing::synthetic(testing::blood(), 0.05, 3);
  MicroRuns kept(factory, alone, 1);
  MicroRuns restored(factory, alone, 1);
  kept.advance(plan(3), testing::short_run(), {});
  restored.restore(kept.states());
  const auto a = kept.advance(plan(3), testing::short_run(), {});
  const auto b = restored.advance(plan(3), testing::short_run(), {});
  EXPECT_EQ(bytes(a, kept), bytes(b, restored));
}

TEST(MicroRuns, callback_sees_every_run_once) {
  const micro::Communicator alone;
  MicroRuns runs(testing::synthetic(testing::blood(), 0.05, 3), alone, 3);
  std::vector<int> slots;
  runs.advance(plan(5), testing::short_run(),
               [&](const FinishedRun& run, const micro::MicroModel<2>& model) {
                 EXPECT_FALSE(model.snapshot().reals.empty());
                 slots.push_back(run.slot);
               });
  EXPECT_THAT(slots, ::testing::UnorderedElementsAre(0, 1, 2, 3, 4));
}

MicroFactory failing(std::function<void(int slot)> fail) {
  return [fail, inside = testing::synthetic(testing::blood(), 0.05, 3)](int slot) {
    return std::make_unique<testing::FailingModel>(inside(slot), [fail, slot] { fail(slot); });
  };
}

TEST(MicroRuns, every_failed_run_is_named_with_slot_shear_rate_and_reason) {
  const micro::Communicator alone;
  MicroRuns runs(failing([](int slot) {
                   if (slot != 1) throw micro::NumericalError("cell 3 turned inside out");
                 }),
                 alone, 2);
  try {
    runs.advance(plan(3), testing::short_run(), {});
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("rank 0: micro run of slot 0 at shear rate 10 1/s: cell 3"));
    EXPECT_THAT(error.what(), HasSubstr("slot 2 at shear rate 30"));
    EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("slot 1")));
  }
  EXPECT_TRUE(runs.states().empty());
}

TEST(MicroRuns, failures_that_are_not_numerical_are_told_apart) {
  const micro::Communicator alone;
  MicroRuns environment(failing([](int) { throw micro::EnvironmentError("disk full"); }), alone, 1);
  EXPECT_THROW(environment.advance(plan(1), testing::short_run(), {}), EnvironmentError);
  MicroRuns odd(failing([](int) { throw 7; }), alone, 1);
  EXPECT_THROW(odd.advance(plan(1), testing::short_run(), {}), EnvironmentError);
  MicroRuns factory(
      [](int) -> std::unique_ptr<micro::MicroModel<2>> {
        throw std::runtime_error("no room for 24 cells");
      },
      alone, 1);
  EXPECT_THROW(factory.advance(plan(1), testing::short_run(), {}), EnvironmentError);
  MicroRuns callback(testing::synthetic(testing::blood(), 0, 3), alone, 1);
  EXPECT_THROW(callback.advance(plan(1), testing::short_run(),
                                [](const FinishedRun&, const micro::MicroModel<2>&) {
                                  throw std::runtime_error("disk full");
                                }),
               EnvironmentError);
}

TEST(MicroRuns, after_a_failure_the_models_are_as_before) {
  const micro::Communicator alone;
  bool fails = false;
  const auto maybe = [&](int slot) {
    if (fails && slot == 1) throw micro::NumericalError("unstable");
  };
  MicroRuns runs(failing(maybe), alone, 1);
  MicroRuns never(failing([](int) {}), alone, 1);
  runs.advance(plan(2), testing::short_run(), {});
  never.advance(plan(2), testing::short_run(), {});
  fails = true;
  EXPECT_THROW(runs.advance(plan(2), testing::short_run(), {}), NumericalError);
  fails = false;
  const auto a = runs.advance(plan(2), testing::short_run(), {});
  const auto b = never.advance(plan(2), testing::short_run(), {});
  EXPECT_EQ(bytes(a, runs), bytes(b, never));
}

}  // namespace
}  // namespace hemoscale::coupling
