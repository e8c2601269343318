#pragma once

#include <string>
#include <vector>

#include "coupling/config/settings.hpp"
#include "coupling/error.hpp"

namespace hemoscale::coupling {

/// Faults of a case that no single key shows: keys that contradict each other, and limits of the
/// methods that the values exceed (unless forced).
std::vector<Fault> find_faults(const Settings& settings, bool force);

}  // namespace hemoscale::coupling
