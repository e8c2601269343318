#pragma once

#include <cstddef>
#include <string>

#include "micro/ensemble/box.hpp"

namespace hemoscale::micro {

/// Largest area fraction at which cells are packed [-]. Biconcave sections at rest leave about a
/// fifth of a random packing free; what is refused below that is refused by its contacts.
inline constexpr double largest_area_fraction = 0.8;

double area_fraction(std::size_t cells, double cell_area, const Box& box);

/// "1200 cells of 1.363e-11 m^2 fill 1.09 of a box of ...", for messages.
std::string describe_fraction(std::size_t cells, double cell_area, const Box& box);

/// What to do against too high a fraction: fewer cells, a longer box, or the deflated outline with
/// the fraction that it would have.
std::string fraction_remedy(std::size_t cells, const Box& box);

/// @throws ParameterError for a fraction above largest_area_fraction
void require_possible_fraction(std::size_t cells, double cell_area, const Box& box);

}  // namespace hemoscale::micro
