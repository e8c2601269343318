#pragma once

#include <string>
#include <vector>

#include "micro/ensemble/blocks/block_settings.hpp"
#include "micro/ensemble/state.hpp"

namespace hemoscale::micro::blocks {

/// All faults of settings and of initial states that do not fit them, one per line; empty if there
/// are none.
/// @param initial  one state per kind of cell
std::string settings_faults(const BlockSettings& settings,
                            const std::vector<EnsembleState>& initial);

}  // namespace hemoscale::micro::blocks
