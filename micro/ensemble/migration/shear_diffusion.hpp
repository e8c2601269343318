#pragma once

#include <cmath>
#include <cstdint>

#include "micro/random/philox.hpp"

namespace hemoscale::micro {

/// Random walk of cells across a sheared suspension, D = K |gamma| a^2 [Leighton and Acrivos 1987],
/// for collisions that a given flow leaves out. Numbers density spreads as d(n)/dt = d/dy (D
/// dn/dy): the step of Ito's equation for it is, for a standard normal number N,
///
///   dy = D'(y) dt + sqrt(2 D dt) N     [m]
///
/// N is a pure function of seed, cell and step: the walk does not depend on ranks or restarts.
struct ShearDiffusion {
  double coefficient = 0;  // [-] K; 0.1 to 1 for dense suspensions of spheres
  double radius = 0;       // [m] a
  std::uint64_t seed = 0;

  /// Displacement of a cell in a step.
  /// @param shear_rate  [1/s] gamma at its centre
  /// @param slope       [1/(m s)] d gamma / dy
  double displacement(std::uint64_t cell, std::uint64_t step, double shear_rate, double slope,
                      double time_step) const {
    const double factor = coefficient * radius * radius;
    const double drift = factor * (shear_rate < 0 ? -slope : slope) * time_step;
    const double spread = std::sqrt(2 * factor * std::abs(shear_rate) * time_step);
    return drift + spread * normal({seed, cell, step});
  }
};

}  // namespace hemoscale::micro
