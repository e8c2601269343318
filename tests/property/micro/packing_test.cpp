#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "micro/ensemble/ensemble_model.hpp"
#include "micro/ensemble/interpenetration.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

std::size_t inside(const EnsembleModel& model, const EnsembleParameters& p) {
  const EnsembleFrame frame = model.frame();
  EnsembleState state;
  state.cells = static_cast<std::size_t>(p.cells);
  state.nodes = static_cast<std::size_t>(p.nodes);
  for (std::size_t i = 0; i < frame.positions.size(); i += 2) {
    state.x.push_back(frame.positions[i]);
    state.y.push_back(frame.positions[i + 1]);
  }
  return count_interpenetrating_nodes(
      state, {.length = frame.length, .height = frame.height, .walls = frame.walls});
}

TEST(Packing, succeeds_up_to_sixty_percent_without_interpenetration) {
  for (const double hematocrit : {0.1, 0.45, 0.6}) {
    EnsembleParameters p;
    p.cells = 12;
    p.nodes = 40;
    p.hematocrit = hematocrit;
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const EnsembleModel model(p, seed);
      EXPECT_EQ(inside(model, p), 0U) << hematocrit << " seed " << seed;
    }
  }
}

TEST(Packing, succeeds_for_ellipses_and_in_a_channel) {
  EnsembleParameters p;
  p.cells = 10;
  p.nodes = 32;
  p.hematocrit = 0.4;
  p.domain = PlaneChannel{.height = 20e-6};
  EXPECT_EQ(inside(EnsembleModel(p, 1), p), 0U);
  p.domain = ShearBox{};
  p.outline = {.outline = Outline::ellipse, .length = 8e-6, .aspect = 0.35};
  EXPECT_EQ(inside(EnsembleModel(p, 1), p), 0U);
}

TEST(Packing, is_decided_by_seed_and_stream) {
  EnsembleParameters p;
  p.cells = 5;
  p.nodes = 24;
  p.hematocrit = 0.3;
  const auto positions = [&](std::uint64_t seed, std::uint64_t stream) {
    return EnsembleModel(p, seed, stream).frame().positions;
  };
  EXPECT_EQ(positions(1, 2), positions(1, 2));
  EXPECT_NE(positions(1, 2), positions(2, 2));
  EXPECT_NE(positions(1, 2), positions(1, 3));
}

TEST(Packing, that_is_impossible_is_refused_with_the_effective_fraction) {
  EnsembleParameters p;
  p.cells = 12;
  p.nodes = 24;
  p.hematocrit = 0.75;
  p.contact.stiffness = 1e-3;  // far too soft to keep cells apart
  try {
    const EnsembleModel model(p, 1);
    FAIL() << inside(model, p);
  } catch (const ParameterError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("half the contact rest distance"));
  }
}

}  // namespace
}  // namespace hemoscale::micro
