#include "coupling/scheme/relaxation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace hemoscale::coupling {

std::vector<Fault> faults_of(const Relaxation& relaxation) {
  std::vector<Fault> faults;
  const double factor = initial_factor(relaxation);
  if (!(factor > 0 && factor <= 2)) {
    Fault fault;
    fault.key = "coupling.relaxation_factor";
    fault.message = fmt::format("{} is not in (0, 2]; 1 is no relaxation", factor);
    faults.push_back(std::move(fault));
  }
  if (const auto* aitken = std::get_if<AitkenRelaxation>(&relaxation)) {
    if (!(aitken->lowest_factor <= factor && factor <= aitken->highest_factor)) {
      Fault fault;
      fault.key = "coupling.relaxation";
      fault.message = fmt::format("bounds {} to {} of the factor do not hold its initial value {}",
                                  aitken->lowest_factor, aitken->highest_factor, factor);
      faults.push_back(std::move(fault));
    }
  }
  return faults;
}

double initial_factor(const Relaxation& relaxation) {
  if (const auto* constant = std::get_if<ConstantRelaxation>(&relaxation)) return constant->factor;
  return std::get<AitkenRelaxation>(relaxation).initial_factor;
}

FactorChoice next_factor(const Relaxation& relaxation, double previous_factor,
                         const std::vector<double>& previous_residual,
                         const std::vector<double>& residual, const std::vector<double>& weights) {
  const auto* aitken = std::get_if<AitkenRelaxation>(&relaxation);
  if (aitken == nullptr) return {std::get<ConstantRelaxation>(relaxation).factor, false};

  assert(previous_residual.size() == residual.size() && weights.size() == residual.size());
  double along = 0;
  double square = 0;
  for (std::size_t i = 0; i < residual.size(); ++i) {
    const double difference = residual[i] - previous_residual[i];
    along += weights[i] * previous_residual[i] * difference;
    square += weights[i] * difference * difference;
  }
  if (square == 0) return {previous_factor, false};
  const double factor = -previous_factor * along / square;
  const double bounded = std::clamp(factor, aitken->lowest_factor, aitken->highest_factor);
  return {bounded, bounded != factor};
}

}  // namespace hemoscale::coupling
