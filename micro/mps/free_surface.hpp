#pragma once

#include <cstddef>
#include <vector>

#include "micro/particles/particle_set.hpp"

namespace hemoscale::micro {

/// Fluid particles whose number density is below ratio n0 belong to a free surface, others to the
/// fluid (Koshizuka and Oka 1996, beta = 0.97). A flat surface row has 0.68 n0 at a kernel radius
/// of 2.1 spacings.
/// @param is_dry  set for all particles below it, walls too: none of them is pressed by fluid
/// @returns the number of surface particles
std::size_t detect_free_surface(const std::vector<double>& density, double reference, double ratio,
                                std::vector<ParticleKind>& kinds, std::vector<char>& is_dry);

}  // namespace hemoscale::micro
