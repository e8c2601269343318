#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace hemoscale::macro {

/// Numbers for property tests: the same on every machine (the standard's distributions are not).
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}

  double between(double low, double high) {
    const double unit = static_cast<double>(engine_() >> 11) * 0x1p-53;
    return low + (high - low) * unit;
  }

  /// Even in the logarithm; both bounds positive.
  double log_between(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace hemoscale::macro
