#pragma once

#include <vector>

#include "coupling/config/settings.hpp"
#include "coupling/scheme/coupled_loop.hpp"
#include "macro/analytic/channel_model.hpp"
#include "macro/vector.hpp"

namespace hemoscale::coupling {

/// @param threads  micro runs at a time on each rank
LoopOptions build_loop_options(const Settings& settings, int threads);

/// The analytic channel of a case with macro.model = "channel".
macro::ChannelModel<2> build_channel(const Settings& settings);

/// Where the analytic channel is sampled [m]: the points of the case, or points from the axis to
/// the lower wall.
std::vector<macro::Vector<2>> channel_points(const Settings& settings);

}  // namespace hemoscale::coupling
