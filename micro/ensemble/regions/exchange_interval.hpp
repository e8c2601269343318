#pragma once

#include <cstdint>

#include "micro/ensemble/blocks/block_settings.hpp"
#include "micro/ensemble/regions/copy_carrier.hpp"

namespace hemoscale::micro::regions {

/// Longest motion time between two exchanges of copies [s], the smaller of
///
///   rc / (80 v)      a copy strays by at most a small part of the contact cutoff: v is the largest
///                    speed of the flow for frozen copies, and for carried ones the largest shear
///                    rate times the radius of a cell, the slip of cells that are in each other's
///                    way
///   8 zeta / k0      a contact of every eighth node relaxes a whole cell in this time;
///                    k0 = 2 A r0^2 (rc^2 - r0^2)^2, stiffness of a pair at its rest distance
///
/// The numbers 80 and 8 follow from measured errors, see micro/ensemble/regions/README.md: below
/// 0.02 um after 2 s for carried copies. Infinite if nothing moves and nothing touches.
double longest_copy_age(const blocks::BlockSettings& settings, CopyMotion motion);

/// The same as a number of steps: at least 1, at most 1000.
std::int64_t exchange_interval(const blocks::BlockSettings& settings, CopyMotion motion);

}  // namespace hemoscale::micro::regions
