#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "micro/ensemble/packing/lattice_packing.hpp"
#include "micro/ensemble/packing/state_checks.hpp"
#include "tests/support/micro/packed_cells.hpp"

namespace hemoscale::micro {
namespace {

using test::refusal;
using testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180;
const std::vector<Vector<2>> human = outline_nodes({}, 60);

std::vector<std::string> faults_of(const LatticePacking& packing, const Box& box) {
  return state_faults(std::span(&packing.state, 1), room_of(box));
}

TEST(LatticePacking, leaves_equal_gaps_and_no_overlap) {
  const Box box{.length = 120e-6, .height = 40e-6, .walls = true};
  const LatticePacking packing =
      pack_on_lattice(human, box, {.cells = 120, .tilt = 2 * degree, .wall_gap = 0.5e-6}, 1, 0);
  EXPECT_EQ(packing.state.cells, 120U);
  EXPECT_EQ(packing.state.x.size(), 120U * 60U);
  EXPECT_GE(packing.shape.rows * packing.shape.columns, 120U);
  // A row more or less would make the smaller gap smaller.
  EXPECT_GT(packing.gap_along, 0);
  EXPECT_GT(packing.gap_across, 0);
  EXPECT_THAT(faults_of(packing, box), testing::IsEmpty());
}

TEST(LatticePacking, takes_the_roomiest_of_all_lattices) {
  const Box box{.length = 150e-6, .height = 60e-6, .walls = false};
  const LatticePacking best = pack_on_lattice(human, box, {.cells = 70}, 1, 0);
  for (std::size_t rows = 1; rows <= 20; ++rows) {
    const LatticeShape shape{rows, (70 + rows - 1) / rows};
    try {
      const LatticePacking other = pack_on_lattice(human, box, {.cells = 70, .shape = shape}, 1, 0);
      EXPECT_LE(std::min(other.gap_along, other.gap_across),
                std::min(best.gap_along, best.gap_across) + 1e-15);
    } catch (const ParameterError&) {
    }
  }
}

// The literal window: ten cells one behind the other across the channel and 120 along it.
TEST(LatticePacking, holds_ten_by_hundred_and_twenty_deflated_cells) {
  const auto thin =
      outline_nodes({.outline = Outline::deflated, .length = 7e-6, .reduced_area = 0.3}, 100);
  const Box box{.length = 200e-6, .height = 75e-6, .walls = true};
  const LatticePacking packing = pack_on_lattice(thin, box,
                                                 {.cells = 1200,
                                                  .shape = LatticeShape{10, 120},
                                                  .orientation = 90 * degree,
                                                  .tilt = 0.5 * degree},
                                                 1, 0);
  EXPECT_NEAR(packing.gap_across, 0.5e-6, 0.02e-6);
  EXPECT_NEAR(packing.gap_along, 0.14e-6, 0.05e-6);
  EXPECT_THAT(faults_of(packing, box), testing::IsEmpty());
}

TEST(LatticePacking, refuses_human_sections_in_that_window_and_names_the_deflated_one) {
  const Box box{.length = 200e-6, .height = 75e-6, .walls = true};
  const std::string text =
      refusal([&] { pack_on_lattice(human, box, {.cells = 1200, .gap = 0.3e-6}, 1, 0); });
  EXPECT_THAT(text, HasSubstr("would fill 1.09"));
  EXPECT_THAT(text, HasSubstr("deflated"));
  EXPECT_THAT(text, HasSubstr("1200 of them fill 0.49"));
  EXPECT_THAT(text, HasSubstr("3e-07 m is needed"));
  EXPECT_THAT(text, HasSubstr("24 rows and 24 columns, 576 cells, fit"));
}

TEST(LatticePacking, tilts_differ_within_the_bound_and_are_decided_by_seed_and_stream) {
  const Box box{.length = 150e-6, .height = 60e-6, .walls = false};
  const auto packed = [&](std::uint64_t seed, std::uint64_t stream) {
    return pack_on_lattice(human, box, {.cells = 40, .tilt = 10 * degree}, seed, stream).state;
  };
  const EnsembleState state = packed(3, 4);
  std::set<double> angles;
  for (std::size_t cell = 0; cell < 40; ++cell) {
    // Node 0 is the tip on the positive first axis, node 30 the opposite one.
    const std::size_t k = 60 * cell;
    const double angle = std::atan2(state.y[k] - state.y[k + 30], state.x[k] - state.x[k + 30]);
    EXPECT_LE(std::abs(angle), 10 * degree + 1e-12);
    angles.insert(angle);
  }
  EXPECT_EQ(angles.size(), 40U);
  EXPECT_LT(*angles.begin(), -5 * degree);
  EXPECT_GT(*angles.rbegin(), 5 * degree);
  EXPECT_EQ(packed(3, 4).y, state.y);
  EXPECT_NE(packed(3, 5).y, state.y);
  EXPECT_NE(packed(2, 4).y, state.y);
}

TEST(LatticePacking, refuses_what_makes_no_lattice) {
  const Box box{.length = 150e-6, .height = 60e-6, .walls = false};
  const auto with = [&](const LatticeOptions& o) {
    return refusal([&] { pack_on_lattice(human, box, o, 1, 0); });
  };
  EXPECT_THAT(with({.cells = 0}), HasSubstr("0 cells"));
  EXPECT_THAT(with({.cells = 9, .shape = LatticeShape{2, 4}}), HasSubstr("a site for each"));
  EXPECT_THAT(with({.cells = 9, .tilt = 2}), HasSubstr("tilt"));
  EXPECT_THAT(refusal([&] { pack_on_lattice(human, {}, {.cells = 9}, 1, 0); }),
              HasSubstr("positive"));
}

}  // namespace
}  // namespace hemoscale::micro
