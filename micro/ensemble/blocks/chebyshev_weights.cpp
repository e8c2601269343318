#include "micro/ensemble/blocks/chebyshev_weights.hpp"

#include <cstddef>

namespace hemoscale::micro::blocks {
namespace {

constexpr double damping = 2.0 / 13;

/// Chebyshev polynomials and two derivatives, by their recurrences.
struct Polynomials {
  std::vector<double> value, first, second;

  Polynomials(int degree, double w) : value{1, w}, first{0, 1}, second{0, 0} {
    for (std::size_t j = 2; j <= static_cast<std::size_t>(degree); ++j) {
      value.push_back(2 * w * value[j - 1] - value[j - 2]);
      first.push_back(2 * value[j - 1] + 2 * w * first[j - 1] - first[j - 2]);
      second.push_back(4 * first[j - 1] + 2 * w * second[j - 1] - second[j - 2]);
    }
  }
};

double shift(int stages) {
  return 1 + damping / (static_cast<double>(stages) * static_cast<double>(stages));
}

}  // namespace

std::vector<StageWeights<double>> chebyshev_weights(int stages) {
  const double w0 = shift(stages);
  const Polynomials t(stages, w0);
  const auto s = static_cast<std::size_t>(stages);
  const double w1 = t.first[s] / t.second[s];
  const auto b = [&](std::size_t j) {
    const std::size_t k = j < 2 ? 2 : j;
    return t.second[k] / (t.first[k] * t.first[k]);
  };
  std::vector<StageWeights<double>> weights(s);
  weights[0].force = b(1) * w1;
  for (std::size_t j = 2; j <= s; ++j) {
    StageWeights<double>& w = weights[j - 1];
    w.before = 2 * b(j) * w0 / b(j - 1);
    w.second = -b(j) / b(j - 2);
    w.base = 1 - w.before - w.second;
    w.force = 2 * b(j) * w1 / b(j - 1);
    w.first_force = -(1 - b(j - 1) * t.value[j - 1]) * w.force;
  }
  return weights;
}

double chebyshev_reach(int stages) {
  const double w0 = shift(stages);
  const Polynomials t(stages, w0);
  const auto s = static_cast<std::size_t>(stages);
  return (w0 + 1) * t.second[s] / t.first[s];
}

}  // namespace hemoscale::micro::blocks
