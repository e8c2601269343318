#pragma once

#include <optional>

#include "micro/ensemble/box.hpp"
#include "micro/ensemble/state.hpp"

namespace hemoscale::micro {

/// Cell-free layer by the envelope of the cells: the channel is cut into columns along x; in each
/// the smallest distance of any membrane from the wall is taken, and these are averaged. Columns
/// without a membrane do not count. Narrow columns give a thicker layer, as they see between cells:
/// the width belongs to the definition. The other definition, by half the area fraction of the
/// core, is `half_core_distance`; the two differ by some 0.3 to 0.5 um.
struct EnvelopeLayer {
  double lower = 0;    // [m] at the wall y = 0
  double upper = 0;    // [m] at the wall y = height
  double covered = 0;  // [-] share of the columns with a membrane

  double mean() const { return 0.5 * (lower + upper); }  // [m]
};

/// @param column_width  [m] rounded so that whole columns fill the length
/// @returns none without a cell
std::optional<EnvelopeLayer> envelope_layer(const EnsembleState& state, const Box& box,
                                            double column_width = 1e-6);

}  // namespace hemoscale::micro
