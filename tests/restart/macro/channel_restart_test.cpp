#include <gtest/gtest.h>

#include <vector>

#include "macro/analytic/channel_model.hpp"
#include "macro/error.hpp"

namespace hemoscale::macro {
namespace {

const Channel channel{75e-6, 0.4, MeanVelocity{2e-3}};

std::vector<double> figures(const FlowField<2>& flow) {
  std::vector<double> values;
  for (int i = 0; i <= 50; ++i) {
    const FlowState<2> state = *flow.at({1e-5, 75e-6 * i / 50.0}, 0);
    values.push_back(state.velocity[0]);
    values.push_back(state.velocity_gradient(0, 1));
    values.push_back(state.pressure);
  }
  return values;
}

TEST(ChannelRestart, continues_with_the_same_bits) {
  ChannelModel<2> through(channel);
  through.advance(Newtonian{1e-3}, {0, 1});
  const std::vector<double> snapshot = through.snapshot();
  const auto expected = figures(*through.advance(cho_kensey_1991(), {1, 2}));
  ChannelModel<2> restored(channel);
  restored.restore(snapshot);
  EXPECT_EQ(figures(*restored.advance(cho_kensey_1991(), {1, 2})), expected);
}

TEST(ChannelRestart, what_was_solved_before_does_not_matter) {
  ChannelModel<2> model(channel);
  const auto first = figures(*model.advance(cho_kensey_1991(), {0, 1}));
  model.advance(Casson{0.5, 3e-3, 1e-6}, {0, 1});
  model.advance(Newtonian{1}, {0, 1});
  EXPECT_EQ(figures(*model.advance(cho_kensey_1991(), {0, 1})), first);
}

TEST(ChannelRestart, refuses_a_snapshot_of_something_else) {
  ChannelModel<2> model(channel);
  EXPECT_NO_THROW(model.restore({}));
  EXPECT_THROW(model.restore({1.0}), ParameterError);
}

}  // namespace
}  // namespace hemoscale::macro
