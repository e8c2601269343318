#include "micro/random/philox.hpp"

#include <cmath>
#include <numbers>

namespace hemoscale::micro {
namespace {

std::uint32_t low(std::uint64_t word) {
  return static_cast<std::uint32_t>(word);
}
std::uint32_t high(std::uint64_t word) {
  return static_cast<std::uint32_t>(word >> 32U);
}

std::array<std::uint32_t, 4> block(const Draw& draw) {
  return philox({low(draw.counter), high(draw.counter), low(draw.stream), high(draw.stream)},
                {low(draw.seed), high(draw.seed)});
}

double unit_interval(std::uint32_t upper, std::uint32_t lower) {
  const std::uint64_t bits = ((std::uint64_t{upper} << 32U) | lower) >> 12U;
  // The middle of 2^52 equal intervals: exact in double, and neither end is hit.
  return (static_cast<double>(bits) + 0.5) * 0x1p-52;
}

}  // namespace

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key) {
  constexpr std::uint64_t multiplier_0 = 0xD2511F53;
  constexpr std::uint64_t multiplier_1 = 0xCD9E8D57;
  constexpr std::uint32_t weyl_0 = 0x9E3779B9;
  constexpr std::uint32_t weyl_1 = 0xBB67AE85;
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t product_0 = multiplier_0 * counter[0];
    const std::uint64_t product_1 = multiplier_1 * counter[2];
    counter = {high(product_1) ^ counter[1] ^ key[0], low(product_1),
               high(product_0) ^ counter[3] ^ key[1], low(product_0)};
    key = {key[0] + weyl_0, key[1] + weyl_1};
  }
  return counter;
}

double uniform(const Draw& draw) {
  const auto word = block(draw);
  return unit_interval(word[0], word[1]);
}

double normal(const Draw& draw) {
  const auto word = block(draw);
  const double radius = std::sqrt(-2 * std::log(unit_interval(word[0], word[1])));
  return radius * std::cos(2 * std::numbers::pi * unit_interval(word[2], word[3]));
}

}  // namespace hemoscale::micro
