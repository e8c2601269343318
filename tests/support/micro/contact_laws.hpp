#pragma once

#include <ostream>
#include <vector>

#include "micro/ensemble/contact_law.hpp"

// Laws of contact of about the same range and stiffness: repulsion up to 0.3 um, cut at 0.5 um.
namespace hemoscale::test {

struct NamedLaw {
  const char* name;
  micro::ContactLaw law;
};
inline void PrintTo(const NamedLaw& law, std::ostream* out) {
  *out << law.name;
}

inline micro::ContactLaw polynomial_contact() {
  return micro::PairPotential{
      .scale = 50e36, .rest_squared = 0.09e-12, .cutoff_squared = 0.25e-12, .attraction = 0.05};
}
inline micro::ContactLaw morse_contact() {
  return micro::MorsePotential{
      .energy_scale = 2e-15, .steepness = 8e6, .rest_distance = 0.3e-6, .cutoff = 0.5e-6};
}
inline micro::ContactLaw lennard_jones_contact() {
  return micro::LennardJonesPotential{
      .energy_scale = 2e-16, .rest_distance = 0.3e-6, .core = 0.22e-6, .cutoff = 0.5e-6};
}

inline std::vector<NamedLaw> contact_laws() {
  return {{"polynomial", polynomial_contact()},
          {"morse", morse_contact()},
          {"lennard_jones", lennard_jones_contact()}};
}

}  // namespace hemoscale::test
