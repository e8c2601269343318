#include "micro/ensemble/neighbour_list.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "micro/ensemble/pair_forces.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::micro {
namespace {

constexpr double range = 1.3;

/// Cells of scattered nodes, partly outside the box.
EnsembleState random_state(const Box& box, std::uint64_t seed) {
  EnsembleState state;
  state.cells = 12;
  state.nodes = 8;
  std::uint64_t counter = 0;
  const auto number = [&] { return uniform({seed, 0, counter++}); };
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    const double x = box.length * number();
    const double y = box.height * number();
    for (std::size_t k = 0; k < state.nodes; ++k) {
      state.x.push_back(x + 3 * (number() - 0.5));
      state.y.push_back(y + (box.walls ? 0.5 : 3) * (number() - 0.5));
    }
  }
  state.image_offset = box.walls ? 0 : box.length * number();
  return state;
}

using Pairs = std::map<std::tuple<std::size_t, std::size_t>, std::pair<double, double>>;

Pairs all_pairs(const EnsembleState& state, const Box& box) {
  Pairs pairs;
  for (std::size_t i = 0; i < state.x.size(); ++i) {
    for (std::size_t j = 0; j < state.x.size(); ++j) {
      for (int row = box.walls ? 0 : -2; row <= (box.walls ? 0 : 2); ++row) {
        for (int column = -4; column <= 4; ++column) {
          const bool own = i / state.nodes == j / state.nodes && row == 0 && column == 0;
          const double dx =
              state.x[i] - (state.x[j] + (column * box.length + row * state.image_offset));
          const double dy = state.y[i] - (state.y[j] + row * box.height);
          if (!own && dx * dx + dy * dy < range * range) {
            pairs[{i, j}] = {dx, dy};
          }
        }
      }
    }
  }
  return pairs;
}

TEST(NeighbourList, finds_the_same_pairs_as_a_search_over_all_images) {
  for (const bool walls : {false, true}) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
      const Box box{.length = 7.0 + static_cast<double>(seed % 5), .height = 6, .walls = walls};
      const EnsembleState state = random_state(box, seed);
      NeighbourList list;
      list.build(state, box, range);
      const ImageTable images(box, state.image_offset);
      const Pairs expected = all_pairs(state, box);
      EXPECT_EQ(list.size(), expected.size()) << "seed " << seed;
      for (std::size_t i = 0; i < state.x.size(); ++i) {
        std::int32_t previous = -1;
        for (const Neighbour& other : list.of(i)) {
          const auto j = static_cast<std::size_t>(other.node);
          const auto image = static_cast<std::size_t>(other.image);
          ASSERT_TRUE(expected.contains({i, j}));
          EXPECT_NEAR(state.x[i] - state.x[j] - images.x[image], (expected.at({i, j}).first),
                      1e-12);
          EXPECT_NEAR(state.y[i] - state.y[j] - images.y[image], (expected.at({i, j}).second),
                      1e-12);
          EXPECT_GT(other.node, previous);
          previous = other.node;
        }
      }
    }
  }
}

TEST(NeighbourList, a_wider_list_gives_the_same_bits) {
  const PairPotential potential = make_pair_potential(3, 0.6, 1.0, 0.3);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Box box{.length = 9, .height = 8};
    const EnsembleState state = random_state(box, seed);
    const ImageTable images(box, state.image_offset);
    std::vector<double> results[2][2];
    int k = 0;
    for (const double reach : {1.0, 1.9}) {
      NeighbourList list;
      list.build(state, box, reach);
      results[k][0].assign(state.x.size(), 1e-3);
      results[k][1].assign(state.x.size(), 1e-3);
      add_pair_forces(state, list, images, potential, 0, state.x.size(), results[k][0].data(),
                      results[k][1].data());
      ++k;
    }
    EXPECT_EQ(results[0][0], results[1][0]);
    EXPECT_EQ(results[0][1], results[1][1]);
  }
}

TEST(PairForces, obey_the_third_law_and_are_the_gradient_of_the_energy) {
  const PairPotential potential = make_pair_potential(3, 0.6, 1.0, 0.3);
  const Box box{.length = 9, .height = 8};
  EnsembleState state = random_state(box, 4);
  const ImageTable images(box, state.image_offset);
  NeighbourList list;
  list.build(state, box, 1.1);
  const std::size_t n = state.x.size();
  std::vector<double> fx(n, 0.0);
  std::vector<double> fy(n, 0.0);
  add_pair_forces(state, list, images, potential, 0, n, fx.data(), fy.data());
  double sum_x = 0;
  double sum_y = 0;
  double scale = 0;
  for (std::size_t i = 0; i < n; ++i) {
    sum_x += fx[i];
    sum_y += fy[i];
    scale = std::max(scale, std::hypot(fx[i], fy[i]));
  }
  ASSERT_GT(scale, 0);
  EXPECT_LE(std::hypot(sum_x, sum_y), 1e-13 * scale * static_cast<double>(n));
  const double h = 1e-6;
  const auto energy = [&] { return sum_pairs(state, list, images, potential, 0, n).energy; };
  for (std::size_t i = 0; i < n; i += 5) {
    const double x = state.x[i];
    state.x[i] = x + h;
    const double ahead = energy();
    state.x[i] = x - h;
    const double behind = energy();
    state.x[i] = x;
    EXPECT_NEAR(fx[i], -(ahead - behind) / (2 * h), 1e-7 * scale);
  }
}

}  // namespace
}  // namespace hemoscale::micro
