#pragma once

#include <cstdint>
#include <numbers>

#include "micro/random/philox.hpp"

namespace hemoscale::micro {

/// Random numbers in the order in which they are asked for. Attempts and purposes that must not
/// share numbers have ranges of counters of their own.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t stream, std::uint32_t range = 0)
      : draw_{seed, stream, static_cast<std::uint64_t>(range) << 32U} {}

  double between(double low, double high) {
    const double u = uniform(draw_);
    ++draw_.counter;
    return low + (high - low) * u;
  }
  double angle() { return between(0, 2 * std::numbers::pi); }  // [rad]

 private:
  Draw draw_;
};

}  // namespace hemoscale::micro
