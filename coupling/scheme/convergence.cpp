#include "coupling/scheme/convergence.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

#include "coupling/error.hpp"

namespace hemoscale::coupling {

std::vector<double> knot_weights(const std::vector<macro::ViscosityRow>& rows) {
  std::vector<double> weights;
  for (const macro::ViscosityRow& row : rows) {
    const std::vector<double>& rates = row.shear_rates;
    const std::size_t last = rates.size() - 1;
    if (last == 0) {
      weights.push_back(1);
      continue;
    }
    const double length = std::log(rates[last] / rates[0]);
    for (std::size_t i = 0; i <= last; ++i) {
      const double below = i == 0 ? 0 : std::log(rates[i] / rates[i - 1]);
      const double above = i == last ? 0 : std::log(rates[i + 1] / rates[i]);
      weights.push_back(0.5 * (below + above) / length);
    }
  }
  return weights;
}

double weighted_rms(const std::vector<double>& values, const std::vector<double>& weights) {
  assert(values.size() == weights.size() && !values.empty());
  double squares = 0;
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    squares += weights[i] * values[i] * values[i];
    sum += weights[i];
  }
  return std::sqrt(squares / sum);
}

void require_no_divergence(const std::vector<double>& changes, const DivergenceLimits& limits,
                           double relaxation_factor) {
  assert(!changes.empty());
  const double change = changes.back();
  const auto fail = [&](const std::string& what) {
    throw NumericalError(fmt::format(
        "coupled iteration diverges at pass {} of the window: {}. Reduce "
        "coupling.relaxation_factor "
        "(the last factor was {:.3g}; at a given pressure gradient and local power-law index n it "
        "must stay below 2 / n) or use coupling.relaxation = \"aitken\"",
        changes.size(), what, relaxation_factor));
  };
  if (!std::isfinite(change)) fail("the change of log viscosity is not finite");
  if (change > limits.largest_change) {
    fail(fmt::format("the change of log viscosity, {:.3g}, exceeds {:.3g}", change,
                     limits.largest_change));
  }
  const auto rises = static_cast<std::size_t>(limits.rising_passes);
  if (change < limits.smallest_change || changes.size() <= rises) return;
  for (std::size_t i = changes.size() - rises; i < changes.size(); ++i) {
    if (changes[i] <= changes[i - 1]) return;
  }
  const double before = changes[changes.size() - 1 - rises];
  if (change < limits.growth * before) return;
  fail(fmt::format("the change of log viscosity rose in {} passes in a row, from {:.3g} to {:.3g}",
                   rises, before, change));
}

}  // namespace hemoscale::coupling
