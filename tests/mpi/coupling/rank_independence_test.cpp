#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <map>
#include <set>
#include <string>

#include "coupling/error.hpp"
#include "coupling/sampling/sample_points.hpp"
#include "coupling/scheme/coupling_scheme.hpp"
#include "macro/analytic/channel_model.hpp"
#include "micro/error.hpp"
#include "tests/support/coupling_doubles.hpp"

// Run with 1, 2 and 3 ranks; every rank compares with the loop that it runs alone.
namespace hemoscale::coupling {
namespace {

using ::testing::HasSubstr;

constexpr double hematocrit = 0.4;
constexpr double height = 1e-4;  // [m]

class Ranks : public ::testing::Test {
 protected:
  static CoupledLoop make_loop(MicroFactory factory, const micro::Communicator& communicator,
                               int threads = 1) {
    LoopOptions options = testing::loop_options(testing::short_run());
    options.relaxation = AitkenRelaxation{0.6, 0.1, 2};
    options.stop_at_noise = false;
    options.threads = threads;
    return CoupledLoop(testing::newtonian(3.5e-3), options, std::move(factory), communicator);
  }

  static MicroFactory noisy() { return testing::synthetic(testing::blood(), 0.05, 7); }

  macro::ChannelModel<2> model_ = [] {
    macro::Channel parameters;
    parameters.height = height;
    parameters.hematocrit = hematocrit;
    parameters.drive = macro::PressureGradient{2 / height};
    return macro::ChannelModel<2>(parameters);
  }();
  CoupledFlow<2> flow_{model_, points_across<2>({0, height / 2}, {0, 0}, 7, 0.1), hematocrit};
  micro::Communicator all_{MPI_COMM_WORLD};
  micro::Communicator alone_;
};

void expect_same(const micro::Snapshot& a, const micro::Snapshot& b) {
  EXPECT_EQ(a.reals, b.reals);
  EXPECT_EQ(a.integers, b.integers);
}

TEST_F(Ranks, law_samples_and_models_have_the_same_bits_on_any_number_of_ranks) {
  CoupledLoop together = make_loop(noisy(), all_);
  CoupledLoop serial = make_loop(noisy(), alone_);
  CoupledLoop threaded = make_loop(noisy(), all_, 2);
  Explicit<2> scheme;
  std::set<int> ranks;
  for (int pass = 0; pass < 4; ++pass) {
    const LoopReport a = scheme.advance(flow_, together, {}, {}).passes.at(0);
    const LoopReport b = scheme.advance(flow_, serial, {}, {}).passes.at(0);
    scheme.advance(flow_, threaded, {}, {});
    EXPECT_EQ(a.change, b.change);
    EXPECT_EQ(a.relaxation_factor, b.relaxation_factor);
    EXPECT_EQ(a.micro_runs, b.micro_runs);
    expect_same(together.snapshot(), serial.snapshot());
    expect_same(threaded.snapshot(), serial.snapshot());
    for (const FinishedRun& run : a.runs) ranks.insert(run.rank);
  }
  EXPECT_EQ(ranks.size(), static_cast<std::size_t>(all_.size()));  // the work was shared
}

TEST_F(Ranks, a_checkpoint_of_many_ranks_continues_on_one_and_back) {
  Explicit<2> scheme;
  CoupledLoop together = make_loop(noisy(), all_);
  scheme.advance(flow_, together, {}, {});
  CoupledLoop serial = make_loop(noisy(), alone_);
  serial.restore(together.snapshot());
  scheme.advance(flow_, serial, {}, {});
  CoupledLoop again = make_loop(noisy(), all_);
  again.restore(serial.snapshot());
  scheme.advance(flow_, again, {}, {});
  scheme.advance(flow_, together, {}, {});
  scheme.advance(flow_, together, {}, {});
  expect_same(again.snapshot(), together.snapshot());
}

TEST_F(Ranks, a_run_that_fails_on_one_rank_fails_on_all_with_one_message) {
  constexpr int bad_slot = 3;
  bool fails = false;
  CoupledLoop loop = make_loop(
      [&, inside = noisy()](int slot) {
        return std::make_unique<testing::FailingModel>(inside(slot), [&fails, slot] {
          if (fails && slot == bad_slot) throw micro::NumericalError("cell 5 turned inside out");
        });
      },
      all_);
  CoupledLoop untroubled = make_loop(noisy(), alone_);
  Explicit<2> scheme;
  fails = true;
  std::string message;
  try {
    scheme.advance(flow_, loop, {}, {});
    ADD_FAILURE() << "no exception on rank " << all_.rank();
  } catch (const NumericalError& error) {
    message = error.what();
  }
  EXPECT_THAT(message, HasSubstr("micro run of slot 3 at shear rate"));
  EXPECT_THAT(message, HasSubstr("cell 5 turned inside out"));
  EXPECT_THAT(message, HasSubstr("rank "));
  for (const std::string& other : all_.all_gather(message)) EXPECT_EQ(other, message);

  fails = false;  // and nothing is left behind on any rank
  scheme.advance(flow_, loop, {}, {});
  scheme.advance(flow_, untroubled, {}, {});
  expect_same(loop.snapshot(), untroubled.snapshot());
}

TEST_F(Ranks, a_point_outside_the_flow_is_the_same_fault_on_all) {
  CoupledFlow<2> outside{model_, {{0, 2 * height}}, hematocrit};
  CoupledLoop loop = make_loop(noisy(), all_);
  EXPECT_THROW(Explicit<2>().advance(outside, loop, {}, {}), CaseError);
  EXPECT_NO_THROW(all_.agree(""));
}

}  // namespace
}  // namespace hemoscale::coupling

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  ::testing::InitGoogleTest(&argc, argv);
  const int failed = RUN_ALL_TESTS();
  int failed_anywhere = 0;
  MPI_Allreduce(&failed, &failed_anywhere, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return failed_anywhere;
}
