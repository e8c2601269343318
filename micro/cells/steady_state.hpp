#pragma once

#include <optional>
#include <span>

namespace hemoscale::micro {

/// When a quantity counts as steady.
struct SteadyCriterion {
  double tolerance = 0.005;  // [-] of the final value
  double window = 0;  // in the unit of the progress, such as ten times the width of a channel for
                      // the distance travelled, or ten for a strain
};

enum class Steadiness {
  settled,
  too_short,  // the progress is below two windows, or the last window has fewer than eight samples
  approaching,  // the last window spans no more than twice the tolerance, but is not as near to the
                // final value: the rest of a slow approach, or a drift
  changing      // the last window spans more than that
};

struct SteadyState {
  Steadiness steadiness = Steadiness::too_short;
  double final_value = 0;  // what the quantity tends to
  double remaining = 0;    // [-] |final - last| / |final|: change that is still to come
  double change = 0;       // [-] largest less smallest value of the last window, over |final|
  // Time from which on the quantity stays within the tolerance of its final value, between samples
  // by a straight line; none unless it is settled.
  std::optional<double> settling_time;
};

/// Looks whether a series has become steady, and since when.
///
/// The final value is that of v = f + a exp(-p / l), p the progress, fitted to the last window by
/// least squares; without a significant trend (variance reduced by less than a factor that one in
/// 10^4 series of white noise reaches) it is the mean of that window. Decay lengths of 0.05 to 20
/// windows are admitted: what changes more slowly than the latter, or grows, is continued for about
/// 20 windows. Settled means that all values of the last window are within the tolerance of the
/// final value, so that a slow approach is not taken for its end. An oscillation that is longer
/// than the window and close to a turning point is not told from a steady state.
///
/// The tolerance is relative: what tends to zero does not settle.
///
/// @param time      [s] of the samples, ascending
/// @param progress  ascending, one for each sample: distance travelled [m], strain [-] or time [s]
/// @param values    one for each sample
/// @throws ParameterError for series of different length, values that are not finite or not in
///         order, a tolerance or a window that is not positive
SteadyState find_steady_state(std::span<const double> time, std::span<const double> progress,
                              std::span<const double> values, const SteadyCriterion& criterion);

}  // namespace hemoscale::micro
