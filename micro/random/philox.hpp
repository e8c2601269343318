#pragma once

#include <array>
#include <cstdint>

namespace hemoscale::micro {

/// Philox4x32-10, a counter-based generator: a pure function of counter and key whose values pass
/// as random [Salmon, Moraes, Dror and Shaw 2011]. Without state, any draw can be repeated on any
/// rank or thread and after any restart.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key);

/// Where a random number comes from: numbers of different seeds, streams or counters are
/// independent.
struct Draw {
  std::uint64_t seed = 0;
  std::uint64_t stream = 0;
  std::uint64_t counter = 0;
};

/// Uniform on (0, 1), never 0 nor 1; 52 random bits.
double uniform(const Draw& draw);

/// Standard normal, by Box and Muller from the two halves of one Philox block.
double normal(const Draw& draw);

}  // namespace hemoscale::micro
