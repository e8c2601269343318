#pragma once

#include <cmath>
#include <string>
#include <variant>

#include "micro/ensemble/lennard_jones_potential.hpp"
#include "micro/ensemble/morse_potential.hpp"
#include "micro/ensemble/pair_potential.hpp"

namespace hemoscale::micro {

/// The law of contact between nodes of different cells. All alternatives have the members
/// force_over_distance(s), energy(s) and curvature(s) of the squared distance s.
using ContactLaw = std::variant<PairPotential, MorsePotential, LennardJonesPotential>;

/// F_i = force_over_distance(law, s) * d [Pa].
inline double force_over_distance(const ContactLaw& law, double s) {
  return std::visit([s](const auto& l) { return l.force_over_distance(s); }, law);
}
/// Energy of a pair per unit depth [N].
inline double pair_energy(const ContactLaw& law, double s) {
  return std::visit([s](const auto& l) { return l.energy(s); }, law);
}
/// d^2 U / dr^2 of a pair [Pa].
inline double pair_curvature(const ContactLaw& law, double s) {
  return std::visit([s](const auto& l) { return l.curvature(s); }, law);
}

/// [m] from which the force is zero.
inline double cutoff_of(const PairPotential& law) {
  return std::sqrt(law.cutoff_squared);
}
inline double cutoff_of(const MorsePotential& law) {
  return law.cutoff;
}
inline double cutoff_of(const LennardJonesPotential& law) {
  return law.cutoff;
}
inline double cutoff_of(const ContactLaw& law) {
  return std::visit([](const auto& l) { return cutoff_of(l); }, law);
}

/// [m] below which nodes repel each other.
inline double rest_distance_of(const PairPotential& law) {
  return std::sqrt(law.rest_squared);
}
inline double rest_distance_of(const MorsePotential& law) {
  return law.zero_of_force();
}
inline double rest_distance_of(const LennardJonesPotential& law) {
  return law.zero_of_force();
}
inline double rest_distance_of(const ContactLaw& law) {
  return std::visit([](const auto& l) { return rest_distance_of(l); }, law);
}

/// [Pa] -dF/dr where the force changes its sign, on the side of repulsion.
inline double stiffness_at_rest(const PairPotential& law) {
  const double depth = law.cutoff_squared - law.rest_squared;
  return 2 * law.scale * law.rest_squared * depth * depth;
}
inline double stiffness_at_rest(const ContactLaw& law) {
  if (const auto* polynomial = std::get_if<PairPotential>(&law)) {
    return stiffness_at_rest(*polynomial);
  }
  const double r = rest_distance_of(law);
  return pair_curvature(law, r * r);
}

/// What is not admissible about a law, one line for each; empty if it is sound.
std::string contact_law_faults(const ContactLaw& law);

}  // namespace hemoscale::micro
