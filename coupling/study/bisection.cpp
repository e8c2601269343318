#include "coupling/study/bisection.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace hemoscale::coupling {

BoundarySearch find_boundary(double stable, double unstable, double tolerance,
                             const std::function<bool(double)>& is_stable) {
  assert(stable > 0 && unstable > 0 && tolerance > 0);
  using Outcome = BoundarySearch::Outcome;
  if (!is_stable(stable)) return {Outcome::stable_nowhere, stable, unstable, 1};
  if (is_stable(unstable)) return {Outcome::stable_everywhere, stable, unstable, 2};
  BoundarySearch search{Outcome::found, stable, unstable, 2};
  while (std::max(search.stable, search.unstable) >
         (1 + tolerance) * std::min(search.stable, search.unstable)) {
    const double middle = std::sqrt(search.stable) * std::sqrt(search.unstable);
    (is_stable(middle) ? search.stable : search.unstable) = middle;
    ++search.asked;
  }
  return search;
}

}  // namespace hemoscale::coupling
