#include "micro/ensemble/regions/region_ensemble.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "micro/error.hpp"
#include "tests/support/micro/dense_channel.hpp"

namespace hemoscale::micro {
namespace {

using blocks::Integrator;
using regions::CopyMotion;
using test::DenseChannel;

constexpr std::int64_t steps = 200;

struct Options {
  Precision precision = Precision::single;
  std::int64_t interval = 1;
  CopyMotion motion = CopyMotion::flow;
  int threads = 1;
};

RegionEnsemble spread(const DenseChannel& channel, const Communicator& all, const Options& o) {
  blocks::BlockSettings settings = channel.settings;
  settings.threads = o.threads;
  return RegionEnsemble(settings, o.precision, part_of_rank({channel.state}, all), all,
                        {.motion = o.motion, .exchange_interval = o.interval});
}

EnsembleState after(std::int64_t n, const DenseChannel& channel, const Communicator& all,
                    const Options& o) {
  RegionEnsemble ensemble = spread(channel, all, o);
  ensemble.advance(n);
  return ensemble.states(true).front();
}

/// Every rank computes what one process alone would.
EnsembleState alone(std::int64_t n, const DenseChannel& channel,
                    Precision precision = Precision::single) {
  BlockEnsemble ensemble(channel.settings, precision, {channel.state});
  ensemble.advance(n);
  return ensemble.states().front();
}

void expect_same_bits(const EnsembleState& a, const EnsembleState& b) {
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.image_offset, b.image_offset);
}

TEST(RegionEnsemble, exchange_in_every_step_gives_the_bits_of_one_process) {
  const Communicator all(MPI_COMM_WORLD);
  const DenseChannel channel = test::dense_channel(6, 5);
  RegionEnsemble ensemble = spread(channel, all, {});
  ensemble.advance(steps);
  EXPECT_EQ(ensemble.exchange_interval(), 1);
  if (all.size() > 1) {
    EXPECT_GT(ensemble.region_counters().copies, 0);
    EXPECT_GT(ensemble.region_counters().messages, steps / 2);
  }
  expect_same_bits(ensemble.states(true).front(), alone(steps, channel));
}

TEST(RegionEnsemble, without_copies_the_cells_would_move_otherwise) {
  // That the test above sees contacts across borders at all.
  const Communicator all(MPI_COMM_WORLD);
  if (all.size() == 1) return;
  const DenseChannel channel = test::dense_channel(6, 5);
  const EnsembleState frozen =
      after(steps, channel, all, {.interval = 200, .motion = CopyMotion::frozen});
  EXPECT_GT(test::rms_distance(frozen, alone(steps, channel)), 0.05e-6);
}

TEST(RegionEnsemble, twofold_precision_and_threads_change_no_bits) {
  const Communicator all(MPI_COMM_WORLD);
  const DenseChannel channel = test::dense_channel(6, 5);
  expect_same_bits(after(100, channel, all, {.precision = Precision::twofold, .threads = 2}),
                   alone(100, channel, Precision::twofold));
  expect_same_bits(after(100, channel, all, {.threads = 3}), alone(100, channel));
}

TEST(RegionEnsemble, an_integrator_with_a_memory_gives_the_bits_of_one_process) {
  const Communicator all(MPI_COMM_WORLD);
  DenseChannel channel = test::dense_channel(6, 5);
  channel.settings.integrator = Integrator::constant_operator;
  expect_same_bits(after(100, channel, all, {.threads = 2}), alone(100, channel));
}

TEST(RegionEnsemble, regions_in_both_directions_give_the_bits_of_one_process) {
  const Communicator all(MPI_COMM_WORLD);
  const DenseChannel channel = test::dense_channel(5, 8, 24);
  RegionEnsemble ensemble = spread(channel, all, {});
  ensemble.advance(steps);
  if (all.size() == 4) {
    EXPECT_EQ(ensemble.region_counters().columns, 2);
  }
  expect_same_bits(ensemble.states(true).front(), alone(steps, channel));
}

TEST(RegionEnsemble, regions_across_sliding_images_give_the_bits_of_one_process) {
  const Communicator all(MPI_COMM_WORLD);
  const DenseChannel channel = test::dense_shear(3, 8);
  RegionEnsemble ensemble = spread(channel, all, {});
  ensemble.advance(steps);
  EXPECT_EQ(ensemble.region_counters().columns, 1);
  expect_same_bits(ensemble.states(true).front(), alone(steps, channel));
}

TEST(RegionEnsemble, fewer_exchanges_cost_little_if_copies_are_carried) {
  const Communicator all(MPI_COMM_WORLD);
  const DenseChannel channel = test::dense_channel(6, 5);
  const EnsembleState exact = alone(steps, channel);
  const auto error = [&](CopyMotion motion, std::int64_t interval) {
    return test::rms_distance(
        after(steps, channel, all, {.interval = interval, .motion = motion, .threads = 2}), exact);
  };
  const double frozen = error(CopyMotion::frozen, 4);
  const double flow = error(CopyMotion::flow, 4);
  if (all.size() == 1) {
    EXPECT_EQ(frozen, 0);
    EXPECT_EQ(flow, 0);
    return;
  }
  EXPECT_GT(flow, 0);
  EXPECT_LT(flow, 0.1 * frozen);
  EXPECT_LT(flow, 0.02e-6);
}

TEST(RegionEnsemble, a_snapshot_continues_with_the_same_bits_on_any_number_of_ranks) {
  const Communicator all(MPI_COMM_WORLD);
  const Communicator single;
  const DenseChannel channel = test::dense_channel(6, 5);
  RegionEnsemble ensemble = spread(channel, all, {});
  ensemble.advance(101);
  const Snapshot snapshot = ensemble.snapshot();
  ensemble.advance(100);
  const EnsembleState uninterrupted = ensemble.states(true).front();

  RegionEnsemble other = spread(channel, all, {});
  other.restore(snapshot);
  EXPECT_EQ(other.step(), 101);
  other.advance(100);
  expect_same_bits(other.states(true).front(), uninterrupted);

  if (!all.is_root()) {
    EXPECT_TRUE(snapshot.reals.empty());
    return;
  }
  RegionEnsemble one(channel.settings, Precision::single, {channel.state}, single, {});
  one.restore(snapshot);
  one.advance(100);
  expect_same_bits(one.states().front(), uninterrupted);
}

TEST(RegionEnsemble, cells_change_their_ranks_as_they_travel) {
  const Communicator all(MPI_COMM_WORLD);
  DenseChannel channel = test::dense_channel(10, 5, 24);
  channel.settings.time_step = 3e-3;
  RegionEnsemble ensemble(channel.settings, Precision::single, part_of_rank({channel.state}, all),
                          all, {.exchange_interval = 1, .copy_growth = 1});
  ensemble.advance(530);
  if (all.size() > 1) {
    EXPECT_GT(ensemble.region_counters().migrations, 1);
  }
  expect_same_bits(ensemble.states(true).front(), alone(530, channel));
}

TEST(RegionEnsemble, a_failure_on_one_rank_is_the_same_failure_on_all) {
  const Communicator all(MPI_COMM_WORLD);
  DenseChannel channel = test::dense_channel(6, 5);
  channel.settings.contact = make_pair_potential(0, 0.3e-6, 0.5e-6, 0.05);
  const std::size_t first = 17 * channel.state.nodes;  // of one cell, which is blown up
  for (std::size_t i = first; i < first + channel.state.nodes; ++i) {
    channel.state.x[i] = channel.state.x[first] + 3 * (channel.state.x[i] - channel.state.x[first]);
    channel.state.y[i] = channel.state.y[first] + 3 * (channel.state.y[i] - channel.state.y[first]);
  }
  RegionEnsemble ensemble = spread(channel, all, {});
  std::string message = "none";
  try {
    ensemble.advance(10);
  } catch (const NumericalError& error) {
    message = error.what();
  }
  EXPECT_THAT(message, testing::HasSubstr("a segment of cell 17 is stretched"));
  EXPECT_THAT(all.all_gather(message), testing::Each(message));
}

TEST(RegionEnsemble, a_fault_on_one_rank_is_refused_by_all) {
  const Communicator all(MPI_COMM_WORLD);
  const DenseChannel channel = test::dense_channel(6, 5);
  auto part = part_of_rank({channel.state}, all);
  if (all.rank() == all.size() - 1) part.front().x.pop_back();
  EXPECT_THROW(RegionEnsemble(channel.settings, Precision::single, part, all), ParameterError);
  EXPECT_THROW(RegionEnsemble(channel.settings, Precision::single,
                              part_of_rank({channel.state}, all), all, {.exchange_interval = -1}),
               ParameterError);
  RegionEnsemble ensemble = spread(channel, all, {});
  EXPECT_THROW(ensemble.restore({}), ParameterError);
  EXPECT_NO_THROW(ensemble.advance(1));
}

TEST(RegionEnsemble, states_without_everywhere_are_those_of_the_root) {
  const Communicator all(MPI_COMM_WORLD);
  const DenseChannel channel = test::dense_channel(6, 5);
  const RegionEnsemble ensemble = spread(channel, all, {});
  EXPECT_EQ(ensemble.states().front().cells, all.is_root() ? channel.state.cells : 0);
}

}  // namespace
}  // namespace hemoscale::micro

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  testing::InitGoogleTest(&argc, argv);
  const int own = RUN_ALL_TESTS();
  int worst = 0;
  MPI_Allreduce(&own, &worst, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return worst;
}
