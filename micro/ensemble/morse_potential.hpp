#pragma once

#include <cmath>

namespace hemoscale::micro {

/// Adhesion of two nodes of different cells by the law of Morse [Morse 1929], as used for the
/// aggregation of red cells [Liu and Liu 2006; Zhang, Johnson and Popel 2008], per unit depth, for
/// d = x_i - x_j and r = |d|:
///
///   phi(r) = D [exp(2 b (re - r)) - 2 exp(b (re - r))],   F(r) = -phi'(r) + phi'(rc) for r < rc,
///
/// else 0 [N/m], along d. The force is shifted so that it is continuous where it is cut; the energy
/// U = phi(r) - phi(rc) - (r - rc) phi'(rc) is once continuously differentiable, and the force
/// vanishes at re - ln(1 - exp(b (re - rc)))/b instead of re. Nodes that coincide have no direction
/// to be pushed in, and no force.
struct MorsePotential {
  double energy_scale = 0;   // [N] D, depth of the well before the shift
  double steepness = 0;      // [1/m] b
  double rest_distance = 0;  // [m] re
  double cutoff = 0;         // [m] rc

  /// F / r [Pa] at the squared distance s [m^2]; exactly zero from the cutoff on.
  double force_over_distance(double s) const {
    return s < cutoff * cutoff && s > 0 ? force(std::sqrt(s)) / std::sqrt(s) : 0;
  }
  /// Energy of the pair per unit depth [N].
  double energy(double s) const {
    const double r = std::sqrt(s);
    if (r >= cutoff) return 0;
    const auto phi = [&](double e) { return energy_scale * e * (e - 2); };
    const double c = decay(cutoff);
    return phi(decay(r)) - phi(c) + (r - cutoff) * slope(c);
  }
  /// d^2 U / dr^2 [Pa].
  double curvature(double s) const {
    if (s >= cutoff * cutoff) return 0;
    const double e = decay(std::sqrt(s));
    return 2 * energy_scale * steepness * steepness * e * (2 * e - 1);
  }
  /// Where the force changes its sign [m].
  double zero_of_force() const { return rest_distance - std::log1p(-decay(cutoff)) / steepness; }

 private:
  double decay(double r) const { return std::exp(steepness * (rest_distance - r)); }
  double slope(double e) const { return 2 * energy_scale * steepness * e * (e - 1); }  // -phi'
  double force(double r) const { return slope(decay(r)) - slope(decay(cutoff)); }
};

}  // namespace hemoscale::micro
