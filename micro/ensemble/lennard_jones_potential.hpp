#pragma once

#include <algorithm>
#include <cmath>

namespace hemoscale::micro {

/// Attraction and repulsion of two nodes of different cells by powers of their distance
/// [Jones 1924], per unit depth, for d = x_i - x_j and r = |d|:
///
///   phi(r) = e [(re/r)^12 - 2 (re/r)^6],   F(r) = -phi'(r) + phi'(rc) for core < r < rc,
///
/// else 0 from rc on [N/m], along d; within the core F continues along its tangent,
/// F(core) + F'(core) (r - core), so that its stiffness is bounded by that at the core. The force
/// is shifted so that it is continuous where it is cut. Nodes that coincide have no direction to be
/// pushed in, and no force.
struct LennardJonesPotential {
  /// Distance of strongest attraction over the rest distance, (13/7)^(1/6).
  static constexpr double steepest = 1.1086834179687216;

  double energy_scale = 0;   // [N] e, depth of the well before the shift
  double rest_distance = 0;  // [m] re
  double core = 0;           // [m]
  double cutoff = 0;         // [m] rc

  /// F / r [Pa] at the squared distance s [m^2]; exactly zero from the cutoff on.
  double force_over_distance(double s) const {
    if (s >= cutoff * cutoff || s <= 0) return 0;
    const double r = std::sqrt(s);
    const double outer = std::max(r, core);
    return (slope(outer) - slope(cutoff) - bend(outer) * (r - outer)) / r;
  }
  /// Energy of the pair per unit depth [N].
  double energy(double s) const {
    const double r = std::sqrt(s);
    if (r >= cutoff) return 0;
    const double outer = std::max(r, core);
    const double inner = r - outer;
    return phi(outer) - phi(cutoff) + (outer - cutoff) * slope(cutoff) -
           (slope(outer) - slope(cutoff)) * inner + 0.5 * bend(outer) * inner * inner;
  }
  /// d^2 U / dr^2 [Pa].
  double curvature(double s) const {
    return s < cutoff * cutoff ? bend(std::max(std::sqrt(s), core)) : 0;
  }
  /// Where the force changes its sign [m], by bisection: it falls up to the steepest attraction.
  double zero_of_force() const {
    double near = core;
    double far = steepest * rest_distance;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (near + far);
      (slope(middle) > slope(cutoff) ? near : far) = middle;
    }
    return near;
  }

 private:
  double sixth(double r) const { return std::pow(rest_distance / r, 6); }
  double phi(double r) const { return energy_scale * sixth(r) * (sixth(r) - 2); }
  double slope(double r) const {  // -phi'
    return 12 * energy_scale * sixth(r) * (sixth(r) - 1) / r;
  }
  double bend(double r) const {  // phi''
    return 12 * energy_scale * sixth(r) * (13 * sixth(r) - 7) / (r * r);
  }
};

}  // namespace hemoscale::micro
