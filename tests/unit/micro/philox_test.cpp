#include "micro/random/philox.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hemoscale::micro {
namespace {

using Block = std::array<std::uint32_t, 4>;

// Known answers published with the generator [Salmon et al. 2011, Random123 kat_vectors].
TEST(Philox, gives_the_published_answers) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Philox, numbers_have_the_moments_of_their_distributions) {
  constexpr std::uint64_t n = 100000;
  double mean = 0;
  double square = 0;
  double normal_mean = 0;
  double normal_square = 0;
  double normal_fourth = 0;
  for (std::uint64_t i = 0; i < n; ++i) {
    const double u = uniform({5, 1, i});
    ASSERT_GT(u, 0);
    ASSERT_LT(u, 1);
    mean += u;
    square += u * u;
    const double g = normal({5, 2, i});
    normal_mean += g;
    normal_square += g * g;
    normal_fourth += g * g * g * g;
  }
  const double root = std::sqrt(static_cast<double>(n));
  const double count = static_cast<double>(n);
  // Four standard errors each.
  EXPECT_NEAR(mean / count, 0.5, 4 * std::sqrt(1.0 / 12) / root);
  EXPECT_NEAR(square / count, 1.0 / 3, 4 * std::sqrt(4.0 / 45) / root);
  EXPECT_NEAR(normal_mean / count, 0, 4 / root);
  EXPECT_NEAR(normal_square / count, 1, 4 * std::sqrt(2.0) / root);
  EXPECT_NEAR(normal_fourth / count, 3, 4 * std::sqrt(96.0) / root);
}

TEST(Philox, seeds_streams_and_counters_are_independent) {
  EXPECT_NE(uniform({1, 0, 0}), uniform({2, 0, 0}));
  EXPECT_NE(uniform({1, 0, 0}), uniform({1, 1, 0}));
  EXPECT_NE(uniform({1, 0, 0}), uniform({1, 0, 1}));
  EXPECT_NE(uniform({1ULL << 32U, 0, 0}), uniform({0, 0, 0}));
  EXPECT_NE(uniform({0, 1ULL << 32U, 0}), uniform({0, 0, 0}));
  EXPECT_NE(uniform({0, 0, 1ULL << 32U}), uniform({0, 0, 0}));
}

}  // namespace
}  // namespace hemoscale::micro
