#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "micro/ensemble/interpenetration.hpp"
#include "micro/ensemble/packing/ring_view.hpp"
#include "micro/ensemble/packing/state_checks.hpp"
#include "micro/random/philox.hpp"
#include "tests/support/micro/packed_cells.hpp"

namespace hemoscale::micro {
namespace {

using test::packing_of;
using testing::HasSubstr;

/// Cells thrown anywhere.
EnsembleState thrown(const std::vector<Vector<2>>& outline, std::size_t cells, const Box& box,
                     std::uint64_t seed) {
  std::vector<test::Placed> places;
  for (std::uint64_t k = 0; k < cells; ++k) {
    const auto draw = [&](std::uint64_t n) { return uniform({seed, n, k}); };
    places.push_back({{(3 * draw(0) - 1) * box.length, (3 * draw(1) - 1) * box.height},
                      2 * std::numbers::pi * draw(2)});
  }
  return test::state_of(outline, places);
}

/// Calls visit for every pair of a ring and an image of a ring, without bins.
template <class Visit>
void for_all_images(const EnsembleState& state, const Box& box, const Visit& visit) {
  for (std::size_t a = 0; a < state.cells; ++a) {
    for (std::size_t b = 0; b < state.cells; ++b) {
      for (int row = -4; row <= 4; ++row) {
        for (int column = -5; column <= 5; ++column) {
          if (a == b && row == 0 && column == 0) continue;
          visit(a, b, Vector<2>(column * box.length + row * state.image_offset, row * box.height));
        }
      }
    }
  }
}

TEST(CellChecks, agree_with_all_pairs_compared_in_boxes_with_sliding_images) {
  const auto outline = outline_nodes({}, 24);
  const Box box{.length = 21e-6, .height = 17e-6, .walls = false};
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    EnsembleState state = thrown(outline, 12, box, seed);
    state.image_offset = (3 * static_cast<double>(seed) - 10) * 1e-6;
    std::size_t inside = 0;
    std::size_t pairs = 0;
    CrossingSearch crosses;
    for_all_images(state, box, [&](std::size_t a, std::size_t b, const Vector<2>& displacement) {
      const RingView one = ring_of(state, a);
      const RingView other = ring_of(state, b);
      bool any_inside = false;
      for (std::size_t i = 0; i < other.nodes(); ++i) {
        if (!contains(one, other.node(i) + displacement)) continue;
        ++inside;
        any_inside = true;
      }
      constexpr Bounds everywhere{-1, 1, -1, 1};
      const bool is_counted =
          a < b ||
          (a == b && (displacement.x() > 0 || (displacement.x() == 0 && displacement.y() > 0)));
      const bool any = any_inside || contains(other, one.node(0) - displacement) ||
                       crosses(one, other, displacement, everywhere);
      if (is_counted && any) ++pairs;
    });
    ASSERT_GT(pairs, 3U);
    EXPECT_EQ(count_interpenetrating_nodes(state, box), inside) << seed;
    EXPECT_EQ(overlaps(std::span(&state, 1), room_of(box, state.image_offset)).size(), pairs)
        << seed;
  }
}

TEST(Occupancy, never_admits_what_the_checks_find_faulty) {
  const Box box{.length = 40e-6, .height = 35e-6, .walls = false};
  const auto outline = outline_nodes({}, 40);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Occupancy occupancy(room_of(box), {}, 8e-6);
    Draws draws(seed, 0);
    const EnsembleState state =
        insert_at_random(occupancy, outline, 60, {0, box.length, 0, box.height}, draws, 200);
    EXPECT_GT(state.cells, 20U);
    EXPECT_THAT(state_faults(std::span(&state, 1), room_of(box)), testing::IsEmpty());
  }
}

TEST(RandomPacking, is_sound_in_channels_and_boxes_up_to_sixty_percent) {
  for (const bool walls : {true, false}) {
    for (const double fraction : {0.15, 0.4, 0.6}) {
      const RandomPacking p = packing_of(48, 40, fraction, 32e-6, walls);
      const EnsembleState state = pack_at_random(p, 1, 0);
      EXPECT_EQ(state.cells, 48U);
      EXPECT_EQ(state.time, 0);
      EXPECT_EQ(state.step, 0);
      EXPECT_THAT(state_faults(std::span(&state, 1), room_of(p.box)), testing::IsEmpty())
          << fraction << (walls ? " channel" : " box");
      for (std::size_t cell = 0; cell < state.cells; ++cell) {
        const RingView ring = ring_of(state, cell);
        double largest = 0;
        for (std::size_t i = 0; i < 40; ++i) {
          const double length = (ring.node((i + 1) % 40) - ring.node(i)).norm();
          largest = std::max(largest, std::abs(length / p.kind.mesh.rest_length[i] - 1));
        }
        EXPECT_LT(largest, 0.3);
      }
    }
  }
}

TEST(RandomPacking, is_decided_by_seed_and_stream_and_not_by_threads) {
  RandomPacking p = packing_of(64, 40, 0.45, 40e-6, true);
  const EnsembleState one = pack_at_random(p, 5, 2);
  p.threads = 3;
  EXPECT_EQ(pack_at_random(p, 5, 2).x, one.x);
  EXPECT_NE(pack_at_random(p, 6, 2).x, one.x);
  EXPECT_NE(pack_at_random(p, 5, 3).x, one.x);
}

// A random arrangement has no preferred direction: the mean of cos 2a vanishes within four standard
// errors, and cells lie everywhere across the channel.
TEST(RandomPacking, turns_cells_every_way) {
  const RandomPacking p = packing_of(200, 40, 0.4, 60e-6, false);
  const EnsembleState state = pack_at_random(p, 1, 0);
  double sum = 0;
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    const RingView ring = ring_of(state, cell);
    const Vector<2> axis = ring.node(0) - ring.node(20);
    sum += (axis.x() * axis.x() - axis.y() * axis.y()) / axis.squaredNorm();
  }
  EXPECT_LT(std::abs(sum / 200), 4 / std::sqrt(2 * 200.0));
}

TEST(RandomPacking, refuses_the_impossible_and_says_what_was_reached) {
  EXPECT_THAT(test::refusal([] {
                RandomPacking p = packing_of(1200, 40, 1, 75e-6, true);
                p.box.length = 200e-6;
                pack_at_random(p, 1, 0);
              }),
              testing::AllOf(HasSubstr("would fill 1.0"), HasSubstr("at most 0.8"),
                             HasSubstr("reduced area 0.3")));
  EXPECT_THAT(test::refusal([] { pack_at_random(packing_of(48, 40, 0.79, 32e-6, true), 1, 0); }),
              testing::AllOf(HasSubstr("outlines cross beyond 0."), HasSubstr("lower")));
  EXPECT_THAT(test::refusal([] {
                RandomPacking p = packing_of(48, 40, 0.4, 32e-6, true);
                p.contact.scale = 0;
                pack_at_random(p, 1, 0);
              }),
              HasSubstr("contact stiffness"));
  EXPECT_THAT(test::refusal([] {
                RandomPacking p = packing_of(48, 40, 0.4, 32e-6, true);
                p.cells = 0;
                pack_at_random(p, 1, 0);
              }),
              HasSubstr("0 cells"));
}

}  // namespace
}  // namespace hemoscale::micro
