#include "coupling/study/pareto.hpp"

#include <cassert>
#include <cmath>
#include <cstddef>

namespace hemoscale::coupling {

std::vector<bool> pareto_front(std::span<const double> costs, std::span<const double> errors) {
  assert(costs.size() == errors.size());
  std::vector<bool> front(costs.size(), false);
  for (std::size_t i = 0; i < costs.size(); ++i) {
    bool is_beaten = !std::isfinite(costs[i]) || !std::isfinite(errors[i]);
    for (std::size_t j = 0; j < costs.size() && !is_beaten; ++j) {
      const bool as_good = costs[j] <= costs[i] && errors[j] <= errors[i];
      is_beaten = as_good && (costs[j] < costs[i] || errors[j] < errors[i]);
    }
    front[i] = !is_beaten;
  }
  return front;
}

}  // namespace hemoscale::coupling
