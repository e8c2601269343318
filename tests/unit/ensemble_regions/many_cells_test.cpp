#include <gtest/gtest.h>

#include "micro/ensemble/regions/region_ensemble.hpp"
#include "tests/support/micro/dense_channel.hpp"

namespace hemoscale::micro {
namespace {

// One rank whose cells exceed the cache: in tiles, and dealt into blocks anew when shear has
// carried those of a block apart.
TEST(ManyCells, dealt_anew_move_as_few_do) {
  const Communicator alone;
  test::DenseChannel channel = test::dense_channel(120, 4, 24, 2e-4);
  channel.settings.time_step = 4e-4;
  const auto run = [&](std::size_t cache) {
    blocks::BlockSettings settings = channel.settings;
    settings.cache = cache;
    RegionEnsemble ensemble(settings, Precision::single, {channel.state}, alone);
    ensemble.advance(5000);
    return std::pair(ensemble.snapshot(), ensemble.region_counters().migrations);
  };
  const auto [few, dealt_once] = run(1U << 30U);
  const auto [many, dealt_again] = run(200000);
  EXPECT_EQ(dealt_once, 1);
  EXPECT_GT(dealt_again, 1);
  EXPECT_EQ(few.reals, many.reals);
  EXPECT_EQ(few.integers, many.integers);
}

}  // namespace
}  // namespace hemoscale::micro
