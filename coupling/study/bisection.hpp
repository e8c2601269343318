#pragma once

#include <functional>

namespace hemoscale::coupling {

/// A boundary between values that are stable and values that are not.
struct BoundarySearch {
  enum class Outcome { found, stable_everywhere, stable_nowhere };
  Outcome outcome = Outcome::found;
  double stable = 0;    // the value nearest to the boundary that was seen to be stable
  double unstable = 0;  // the same, not stable
  int asked = 0;        // [-] values that were tried
};

/// Narrows the boundary between two positive values by geometric halving, until they are within a
/// factor of 1 + tolerance. Both ends are tried first; if they do not differ, the outcome says so
/// and nothing is halved. If stability changes more than once in between, one of the changes is
/// found.
///
/// @param stable, unstable  either may be the larger one
/// @param is_stable         asked once per value; what it throws ends the search
BoundarySearch find_boundary(double stable, double unstable, double tolerance,
                             const std::function<bool(double)>& is_stable);

}  // namespace hemoscale::coupling
